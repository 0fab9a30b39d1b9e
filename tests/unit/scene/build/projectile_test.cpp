// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include "limber/common/records/manifest.hpp"
#include "limber/dynamics/system/model_fields.hpp"
#include "unit/scene/scene_folder.hpp"
#include "unit/scene/temporary_file.hpp"

/// Projectiles from the scenario to their motion, against closed forms.
namespace limber::scene::projectile_test {
namespace {

using test::input_error;
using test::kWorld;
using test::rigid_link;
using test::SceneFolder;
using test::simulate_probes;
using test::time_table;
using ::testing::HasSubstr;

const std::string kBall =
    "[[projectile]]\nname = 'ball'\nradius = 0.5\nmass = 2.0\n"
    "position = [1.0, 2.0, 3.0]\n";

std::string probe(const std::string& quantity, const std::string& more = "") {
  return "[[probe]]\nname = '" + quantity + "'\nlink = 'ball'\nquantity = '" +
         quantity + "'\n" + more;
}

// m = 2 kg, 2/5 m r^2 = 0.2 kg m^2.
TEST(Projectile, IsASolidSphere) {
  const SceneFolder folder;
  const BuiltScene built = folder.build(kWorld, time_table(1.0, 0.1) + kBall);
  ASSERT_EQ(built.model.bodies.size(), 1U);
  EXPECT_EQ(built.model.bodies[0].name, "ball");
  EXPECT_EQ(built.model.bodies[0].mass, 2.0);
  EXPECT_LT((built.model.bodies[0].J0 - 0.2 * Matrix3::Identity()).norm(),
            1e-15);
  EXPECT_EQ(built.initial.bodies[0].p_WB, Vector3(1, 2, 3));
}

// x = x_0 + v t + g t^2 / 2, and the spin stays.
TEST(Projectile, FliesOnAParabola) {
  const SceneFolder folder;
  const BuiltScene built = folder.build(
      kWorld, time_table(1.0, 1e-2) + kBall +
                  "velocity = [4.0, 5.0, 6.0]\nangular_velocity = [0.0, 0.0, "
                  "7.0]\n[gravity]\nacceleration = [0.0, 0.0, -9.0]\n" +
                  probe("position") + probe("angular_velocity"));
  const auto end = simulate_probes(built);
  const double expected[] = {5.0, 7.0, 4.5, 0.0, 0.0, 7.0};
  for (int i = 0; i < 6; ++i)
    EXPECT_NEAR(end[std::size_t(i)], expected[i], 1e-9);
}

// M t / (2/5 m r^2) about x, and F t / m.
TEST(Projectile, FollowsLoads) {
  const SceneFolder folder;
  const BuiltScene built = folder.build(
      kWorld,
      time_table(0.5, 1e-2) + kBall +
          "[[load]]\nname = 'l'\nlink = 'ball'\nframe = 'world'\nforce = [0.0, "
          "3.0, 0.0]\nmoment = [0.1, 0.0, 0.0]\n" +
          probe("velocity") + probe("angular_velocity"));
  const auto end = simulate_probes(built);
  EXPECT_NEAR(end[1], 0.75, 1e-9);
  EXPECT_NEAR(end[3], 0.25, 1e-9);
}

// Its start is in the world, not in the root link's frame.
TEST(Projectile, DoesNotFollowARobotThatMoves) {
  const SceneFolder folder;
  const BuiltScene built = folder.build(
      rigid_link("base", 3.0, 1.0) + rigid_link("arm", 1.0, 1.0, "1 0 0") +
          "<joint name='j' type='continuous'><parent link='base'/><child "
          "link='arm'/><axis xyz='0 0 1'/></joint>\n",
      time_table(1.0, 1e-2) +
          "[initial.base]\nposition = [5.0, 0.0, 0.0]\nvelocity = [0.0, 1.0, "
          "0.0]\n" +
          kBall + "orientation_rpy = [0.0, 0.0, 1.5707963267948966]\n" +
          probe("position", "point = [0.5, 0.0, 0.0]\n"));
  ASSERT_EQ(built.model.bodies.size(), 3U);
  EXPECT_EQ(built.initial.bodies[2].v_WB_W, Vector3::Zero());
  const auto end = simulate_probes(built);
  EXPECT_NEAR(end[0], 1.0, 1e-12);
  EXPECT_NEAR(end[1], 2.5, 1e-12);
}

// Default stiffness follows from what joints carry.
TEST(Projectile, DoesNotStiffenJointsThatDoNotCarryIt) {
  const SceneFolder folder;
  const auto find_joint = [&](const std::string& more) {
    const BuiltScene built = folder.build(
        rigid_link("base", 3.0, 1.0) + rigid_link("arm", 1.0, 1.0, "1 0 0") +
            "<joint name='j' type='continuous'><parent link='base'/><child "
            "link='arm'/><axis xyz='0 0 1'/></joint>\n",
        time_table(1.0, 1e-2) + more);
    Manifest manifest;
    describe(manifest, "", built.model.couplers);
    return manifest.text();
  };
  EXPECT_EQ(find_joint(""),
            find_joint(kBall +
                       "angular_velocity = [0.0, 0.0, 1000.0]\n[[load]]\n"
                       "name = 'l'\nlink = 'ball'\nforce = [0.0, 1e9, 0.0]\n"));
}

TEST(Projectile, NeedsANameOfItsOwn) {
  const SceneFolder folder;
  const auto error_of = [&](const std::string& scenario) {
    return input_error([&] {
      (void)folder.load(rigid_link("base", 3.0, 1.0),
                        time_table(1.0, 1e-2) + scenario);
    });
  };
  const std::string wall =
      "[[obstacle]]\nname = 'ball'\nshape = 'sphere'\nradius = 1.0\nposition = "
      "[9.0, 0.0, 0.0]\n";
  EXPECT_THAT(error_of(kBall + wall),
              HasSubstr("obstacle 'ball' has the same name as another link, "
                        "robot, projectile or obstacle; rename it"));
  for (const char* name : {"base", "world"}) {
    EXPECT_THAT(error_of("[[projectile]]\nname = '" + std::string(name) +
                         "'\nradius = 0.5\nmass = 2.0\nposition = [1.0, 2.0, "
                         "3.0]\n"),
                HasSubstr("projectile '" + std::string(name) +
                          "' has the same name as"));
  }
}

TEST(Projectile, DoesNotDeform) {
  const SceneFolder folder;
  EXPECT_THAT(input_error([&] {
                (void)folder.load(kWorld, time_table(1.0, 1e-2) + kBall +
                                              probe("deformation"));
              }),
              HasSubstr("link 'ball' is rigid"));
}

}  // namespace
}  // namespace limber::scene::projectile_test
