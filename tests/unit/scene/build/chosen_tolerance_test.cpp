// SPDX-License-Identifier: BSD-3-Clause
// The tolerance of scenes that give neither a step nor one.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "unit/scene/scene_folder.hpp"

namespace limber::scene::chosen_tolerance_test {
namespace {

using test::kWorld;
using test::rigid_link;
using test::SceneFolder;

// A link of a size [m]: twice the radius of gyration, 2 sqrt(1.5 J / m).
std::string make_link(const std::string& name, double size) {
  const double mass = 2.0;
  return rigid_link(name, mass, mass * size * size / 6.0);
}

std::string join(const std::string& type, const std::string& parent,
                 const std::string& child) {
  return fmt::format(
      "<joint name='to_{2}' type='{0}'><parent link='{1}'/><child link='{2}'/>"
      "<axis xyz='1 0 0'/><limit lower='-1' upper='1' effort='1' "
      "velocity='1'/></joint>\n",
      type, parent, child);
}

double choose(const std::string& links) {
  const SceneFolder folder;
  return folder.build(kWorld + links, "[time]\nduration = 1.0\n")
      .settings.tolerance;
}

// A stranger of 100 m gave a gripper of 0.1 m a tolerance of 1 cm.
TEST(ChosenTolerance, IsThatOfTheSmallestOfGroupsThatAreNotLinked) {
  const std::string gripper =
      make_link("gripper", 0.1) + join("floating", "world", "gripper");
  const std::string stranger =
      make_link("stranger", 100.0) + join("floating", "world", "stranger");
  EXPECT_NEAR(choose(gripper), 1e-5, 1e-17);
  EXPECT_NEAR(choose(stranger), 1e-2, 1e-14);
  EXPECT_NEAR(choose(gripper + stranger), 1e-5, 1e-17);
  EXPECT_NEAR(choose(stranger + gripper), 1e-5, 1e-17);
}

TEST(ChosenTolerance, IsThatOfTheLargestBodyOfAGroup) {
  const std::string links = make_link("arm", 2.0) + make_link("finger", 0.1);
  EXPECT_NEAR(choose(links + join("floating", "world", "arm") +
                     join("prismatic", "arm", "finger")),
              2e-4, 1e-16);
  // The world does not link them.
  EXPECT_NEAR(choose(links + join("prismatic", "world", "arm") +
                     join("prismatic", "world", "finger")),
              1e-5, 1e-17);
}

}  // namespace
}  // namespace limber::scene::chosen_tolerance_test
