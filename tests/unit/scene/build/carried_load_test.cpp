// SPDX-License-Identifier: BSD-3-Clause
// Default hinges between rigid links, by their estimated loads in a scene.
#include "limber/scene/build/carried_load.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "unit/scene/scene_folder.hpp"

namespace limber::scene::carried_load_test {
namespace {

using test::kWorld;
using test::rigid_link;
using test::SceneFolder;
using test::simulate_probes;
using test::time_table;

constexpr double kMass = 0.2;    // [kg]
constexpr double kReach = 7e-3;  // of the centre of mass from the hinge [m]
constexpr double kAllowed = 1e-4;

// A crank of 7 mm on a hinge without parameters.
std::string crank() {
  return kWorld + rigid_link("body", kMass, 1e-6, "0.007 0 0") +
         "<joint name='j' type='continuous'><parent link='world'/>"
         "<child link='body'/><axis xyz='0 0 1'/></joint>\n";
}

std::string spin(double rate) {
  return fmt::format("[initial.joints]\nj = {{ velocity = {} }}\n", rate);
}

joints::CouplerResponse strain(const BuiltScene& built, std::size_t coupler) {
  return joints::evaluate(built.model.couplers[coupler].law, {}, {}, {});
}

double find_stiffness(const BuiltScene& built, std::size_t coupler = 0) {
  return strain(built, coupler).stiffness(0, 0);
}

double default_stiffness(double mass) {
  return mass * std::pow(2.0 * std::numbers::pi * dynamics::kRigidFrequency, 2);
}

TEST(CarriedLoad, HoldsAFastCrankOnItsHinge) {
  constexpr double kRate = 1000.0;  // [rad/s]
  const SceneFolder folder;
  const BuiltScene built =
      folder.build(crank(), time_table(0.02, 1e-5) + spin(kRate) +
                                "[[probe]]\nname = 'gap'\ncoupler = 'j'\n"
                                "quantity = 'relative_position'\n");
  const auto gap = simulate_probes(built);
  const double opening = Vector3(gap[0], gap[1], gap[2]).norm();
  // It oscillates about m w^2 r / k with that amplitude, since it starts
  // unstressed.
  EXPECT_LT(opening, 2.0 * kAllowed * kReach);
  EXPECT_GT(opening, 0.0);
}

TEST(CarriedLoad, CountsWhatDrivesCommand) {
  constexpr double kRate = 5000.0;  // [rad/s]
  const SceneFolder folder;
  const BuiltScene built = folder.build(
      crank(), time_table(0.01, 1e-5) +
                   fmt::format("[[drive]]\njoint = 'j'\nmode = 'velocity'\n"
                               "damping = 1e-3\n"
                               "signal = {{ kind = 'constant', value = {} }}\n",
                               kRate));
  const double needed = kMass * kRate * kRate / kAllowed;  // m w^2 r / (1e-4 r)
  EXPECT_NEAR(find_stiffness(built), needed, 1e-9 * needed);
}

TEST(CarriedLoad, CountsLoadsAndWeightBeyondTheJoint) {
  const SceneFolder folder;
  const BuiltScene built =
      folder.build(crank(), time_table(0.01, 1e-5) +
                                "[gravity]\nacceleration = [0, 0, -10]\n"
                                "[[load]]\nname = 'l'\nlink = 'body'\n"
                                "force = [0, 3e5, 4e5]\n"
                                "point = [0.014, 0, 0]\n");
  const double needed = (5e5 + 10.0 * kMass) / (kAllowed * kReach);
  EXPECT_NEAR(find_stiffness(built), needed, 1e-9 * needed);
  const double turned = (5e5 * 0.014 + 10.0 * kMass * kReach) / kAllowed;
  EXPECT_NEAR(strain(built, 0).stiffness(3, 3), turned, 1e-9 * turned);
}

TEST(CarriedLoad, LeavesSlowScenesAsTheyWere) {
  const SceneFolder folder;
  for (const double rate : {0.0, 1.0, 60.0}) {
    const BuiltScene built =
        folder.build(crank(), time_table(0.01, 1e-5) + spin(rate));
    EXPECT_DOUBLE_EQ(find_stiffness(built), default_stiffness(kMass));
  }
}

TEST(CarriedLoad, LeavesWhatIsGivenAlone) {
  const SceneFolder folder;
  const BuiltScene built = folder.build(
      crank() + "<coupler joint='j' translational_stiffness='12345'/>\n",
      time_table(0.01, 1e-5) + spin(1000.0));
  EXPECT_DOUBLE_EQ(find_stiffness(built), 12345.0);
}

TEST(CarriedLoad, OfAJointIsThatOfAllLinksBeyondIt) {
  const SceneFolder folder;
  constexpr double kRate = 2000.0;
  const std::string arm =
      rigid_link("far", 3.0, 1e-6, "0.02 0 0") +
      "<joint name='k' type='continuous'><parent link='body'/>"
      "<child link='far'/><origin xyz='0.014 0 0'/><axis xyz='0 0 1'/>"
      "</joint>\n";
  const BuiltScene built =
      folder.build(crank() + arm, time_table(0.01, 1e-5) + spin(kRate));
  // Both turn about the first hinge; the links' size is the 14 mm between.
  const double w2 = kRate * kRate;
  const double far = 3.0 * w2 * 0.034;
  EXPECT_NEAR(find_stiffness(built, 1), far / (kAllowed * 0.014),
              1e-9 * far / (kAllowed * 0.014));
  const double both = far + kMass * w2 * kReach;
  EXPECT_NEAR(find_stiffness(built, 0), both / (kAllowed * 0.014),
              1e-9 * both / (kAllowed * 0.014));
}

}  // namespace
}  // namespace limber::scene::carried_load_test
