// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include "limber/scene/build/unused_keys.hpp"
#include "unit/scene/scene_folder.hpp"

namespace limber::scene::unused_contact_keys_test {
namespace {

using test::kWorld;
using test::SceneFolder;
using test::time_table;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string kBalls =
    "[[projectile]]\nname = 'a'\nradius = 0.1\nmass = 1.0\nposition = [0.0, "
    "0.0, 0.0]\n"
    "[[projectile]]\nname = 'b'\nradius = 0.1\nmass = 1.0\nposition = [1.0, "
    "0.0, 0.0]\n";
const std::string kFloor =
    "[[obstacle]]\nname = 'floor'\nshape = 'plane'\nnormal = [0.0, 0.0, 1.0]\n"
    "position = [0.0, 0.0, -1.0]\n";
const std::string kOptions = "friction = 0.3\nrestitution = 0.5\n";

std::vector<std::string> warnings_of(const std::string& scenario) {
  const SceneFolder folder;
  return folder.load(kWorld, time_table(1.0, 0.1) + kBalls + scenario)
      .scenario.warnings;
}

TEST(UnusedContactKeys, AreNoneWhereAllAct) {
  EXPECT_THAT(warnings_of(kFloor + "[contact_default]\n" + kOptions +
                          "[[contact]]\nbetween = ['*', 'floor']\n"
                          "[[contact]]\nbetween = ['a', 'b']\ndamping = 0.1\n"),
              IsEmpty());
}

TEST(UnusedContactKeys, AreDefaultsThatNoContactTakes) {
  EXPECT_THAT(warnings_of("[contact_default]\n" + kOptions),
              ElementsAre("[contact_default] changes nothing: there is no "
                          "[[contact]]"));
  EXPECT_THAT(warnings_of("[contact_default]\n" + kOptions +
                          "[[contact]]\nbetween = ['a', 'b']\nfriction = "
                          "0.1\ndamping = 0.1\n"),
              ElementsAre("[contact_default] friction changes nothing: every "
                          "[[contact]] has its own",
                          "[contact_default] restitution changes nothing: "
                          "every [[contact]] has its own"));
}

TEST(UnusedContactKeys, AreSpeedsOfNoStaticFriction) {
  EXPECT_THAT(warnings_of("[[contact]]\nbetween = ['a', 'b']\n" + kOptions +
                          "stribeck_speed = 0.1\n"),
              ElementsAre("stribeck_speed of [[contact]] 1 changes nothing: "
                          "there is no static_friction"));
}

TEST(UnusedContactKeys, AreObstaclesThatNothingTouches) {
  EXPECT_THAT(
      warnings_of(kFloor + "[[contact]]\nbetween = ['a', 'b']\n" + kOptions),
      ElementsAre("obstacle 'floor' changes nothing: no [[contact]] names it"));
}

TEST(UnusedContactKeys, AreContactsThatOthersDecide) {
  EXPECT_THAT(
      warnings_of("[[contact]]\nbetween = ['*', 'b']\n" + kOptions +
                  "[[contact]]\nbetween = ['a', 'b']\n" + kOptions),
      ElementsAre(HasSubstr("[[contact]] 1 changes nothing: other [[contact]] "
                            "tables take precedence for all its pairs")));
}

}  // namespace
}  // namespace limber::scene::unused_contact_keys_test
