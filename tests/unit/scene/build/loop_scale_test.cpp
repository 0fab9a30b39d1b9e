// SPDX-License-Identifier: BSD-3-Clause
// Loops and gears are judged by their own sizes.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "unit/scene/scene_folder.hpp"
#include "unit/scene/temporary_file.hpp"

namespace limber::scene::loop_scale_test {
namespace {

using test::input_error;
using test::kWorld;
using test::rigid_link;
using test::SceneFolder;
using test::time_table;
using ::testing::HasSubstr;

const std::string kTime = time_table(0.1, 1e-3);

std::string joint(const std::string& name, const std::string& child,
                  const std::string& type, const std::string& more = "",
                  const std::string& parent = "world") {
  return fmt::format(
      "<joint name='{}' type='{}'><parent link='{}'/><child link='{}'/>"
      "<axis xyz='0 0 1'/><limit effort='0' velocity='0'/>{}</joint>\n",
      name, type, parent, child, more);
}

/// Bodies a (2 kg, 0.1 kg m^2) and b (4 kg, 0.3 kg m^2) on joints j and k.
std::string two_bodies(const std::string& type_j, const std::string& type_k,
                       const std::string& more_j = "") {
  return kWorld + rigid_link("a", 2.0, 0.1) + rigid_link("b", 4.0, 0.3) +
         joint("j", "a", type_j, more_j) + joint("k", "b", type_k);
}

// A gap of 1 mm in links of 1 m, at home and 10 km away, alone and 1 km from
// another arm.
TEST(LoopScale, ClosesALoopToItsOwnSize) {
  const SceneFolder folder;
  for (const double place : {0.0, 1e4}) {
    for (const bool has_stranger : {false, true}) {
      const auto error = [&](double gap) {
        std::string robot =
            kWorld + rigid_link("a", 2.0, 0.1) + rigid_link("b", 2.0, 0.1) +
            joint("j", "a", "continuous",
                  fmt::format("<origin xyz='{} 0 0'/>", place)) +
            joint("k", "b", "continuous", "<origin xyz='1 0 0'/>", "a");
        if (has_stranger) {
          robot += rigid_link("c", 2.0, 0.1) +
                   joint("l", "c", "continuous", "<origin xyz='0 2e3 0'/>");
        }
        robot += fmt::format(
            "<loop name='o' kind='ball' from='b' from_xyz='1 0 0' to='world' "
            "to_xyz='{} {} 0'/>",
            place + 2.0, gap);
        return input_error([&] { (void)folder.build(robot, kTime); });
      };
      EXPECT_EQ(error(0.0), "") << place << ' ' << has_stranger;
      EXPECT_THAT(error(1e-3), HasSubstr("its ends are 0.001 m apart"))
          << place << ' ' << has_stranger;
    }
  }
}

// An error of 1e-10 m of micrometres is not round-off.
TEST(LoopScale, StrainsAGearByItsOwnSize) {
  const SceneFolder folder;
  const auto warnings = [&](double k) {
    return folder
        .build(two_bodies("prismatic", "prismatic") +
                   "<gear name='g' joint='j' with='k' ratio='2'/>",
               kTime + fmt::format("[initial.joints]\nj={{position=2e-9}}\n"
                                   "k={{position={}}}\n",
                                   k))
        .warnings;
  };
  EXPECT_TRUE(warnings(1e-9).empty());
  EXPECT_THAT(warnings(0.9e-9),
              ::testing::ElementsAre(HasSubstr("gear 'g' starts strained")));
}

}  // namespace
}  // namespace limber::scene::loop_scale_test
