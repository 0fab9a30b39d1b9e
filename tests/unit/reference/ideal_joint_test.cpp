// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "limber/reference/verification.hpp"
#include "unit/reference/scene_folder.hpp"

/// Ideal joints against Simbody's mobilizers.
namespace limber::reference::ideal_joint_test {
namespace {

using test::make_joint;
using test::make_link;
using test::RigidScene;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

/// A tree with two branches and a joint of every kind, about tilted axes.
std::string make_tree() {
  std::string robot = "<robot name=\"tree\"><link name=\"world\"/>";
  for (const char* link : {"a", "b", "c", "d", "e", "f"}) {
    robot += make_link(link, 0.6 + 0.1 * (link[0] - 'a'));
  }
  return robot + make_joint("hinge", "continuous", "world", "a", "1 2 -1") +
         make_joint("slide", "prismatic", "a", "b", "0 1 1") +
         make_joint("plane", "planar", "b", "c", "1 0 1") +
         make_joint("cross", "floating", "a", "d") +
         make_joint("socket", "floating", "d", "e") +
         make_joint("weld", "fixed", "e", "f") +
         R"(<coupler joint="cross" kind="universal" axis="2 -1 2"
              second_axis="1 4 1">
              <spring coordinate="1" stiffness="2" rest="0.3"/>
              <friction coordinate="2" viscous="0.05"/></coupler>
            <coupler joint="socket" kind="ball" free_damping="0.01"/>
            <coupler joint="slide"><spring stiffness="30"/></coupler>
            <coupler joint="plane" free_damping="0.02"/>
            </robot>)";
}

std::string make_scenario(const std::string& integrator) {
  return fmt::format(
      "[time]\nduration = 0.4\nstep = 2e-3\noutput_interval = 0.05\n"
      "integrator = \"{}\"\n"
      "[gravity]\nacceleration = [0.5, -1.0, -9.81]\n[initial.joints]\n"
      "hinge = {{ position = 0.4, velocity = 2.0 }}\n"
      "slide = {{ velocity = -0.3 }}\n"
      "plane = {{ position = [0.1, -0.1, 0.8], velocity = [0.2, 0.1, 3.0] }}\n"
      "cross = {{ position = [0.5, -0.7], velocity = [1.0, 2.0] }}\n"
      "socket = {{ position = [0.2, 0.4, -0.3], velocity = [2.0, 1.0, -1.0] "
      "}}\n",
      integrator);
}

class IdealTree : public ::testing::TestWithParam<const char*> {};

TEST_P(IdealTree, MovesAsSimbodysDoesToSecondOrderInTheStep) {
  const RigidScene scene(make_tree(), make_scenario(GetParam()),
                         {{"robot.joint", "ideal"}});
  const Verification result =
      verify(scene.scene, scene.built, {{JointModel::ideal, 1e-12}, 3});
  std::vector<double> relative;
  for (const Agreement& run : result.runs) {
    relative.push_back(find_relative(run.largest, result.motion));
  }
  EXPECT_LT(relative[0], 1e-2);
  EXPECT_NEAR(std::log2(relative[1] / relative[2]), 2.0, 0.3);
  EXPECT_NEAR(std::log2(relative[2] / relative[3]), 2.0, 0.2);
  EXPECT_LT(result.runs[3].energy, 1e-3 * result.energy);
}

INSTANTIATE_TEST_SUITE_P(Implicit, IdealTree,
                         ::testing::Values("generalized-alpha",
                                           "energy-conserving"),
                         [](const auto& tree) {
                           std::string name = tree.param;
                           std::erase(name, '-');
                           return name;
                         });

TEST(Verify, ComparesIdealJointsWithIdealOnesOnly) {
  const RigidScene scene(make_tree(), make_scenario("generalized-alpha"),
                         {{"robot.joint.hinge.ideal", "true"}});
  EXPECT_THAT(
      [&] {
        (void)verify(scene.scene, scene.built,
                     {{JointModel::bushings, 1e-8}, 0});
      },
      ThrowsMessage<InputError>(HasSubstr("joint 'hinge' is ideal")));
}

}  // namespace
}  // namespace limber::reference::ideal_joint_test
