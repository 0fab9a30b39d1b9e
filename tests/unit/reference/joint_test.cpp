// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "limber/reference/scene_mechanism.hpp"
#include "limber/reference/verification.hpp"
#include "unit/reference/scene_folder.hpp"

/// Universal and ball joints, and what acts in joints.
namespace limber::reference::joint_test {
namespace {

using test::make_joint;
using test::make_link;
using test::RigidScene;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

// Normal to each other, along no axis of anything.
constexpr const char* kCross =
    R"(kind="universal" axis="2 -1 2" second_axis="1 4 1")";

/// A link on a universal joint to the world and one on a ball joint to it.
/// What acts in them comes as attributes and elements of <coupler>.
std::string make_robot(const std::string& universal, const std::string& ball) {
  return "<robot name=\"pair\"><link name=\"world\"/>" + make_link("a", 1.0) +
         make_link("b", 0.7) + make_joint("cross", "floating", "world", "a") +
         make_joint("socket", "floating", "a", "b") +
         "<coupler joint=\"cross\" " + kCross + " " + universal +
         "</coupler><coupler joint=\"socket\" " + R"(kind="ball" )" + ball +
         "</coupler></robot>";
}

const std::string kStiff =
    R"(translational_stiffness="1e5" rotational_stiffness="1e5">)";

std::string make_scenario(double duration, double step,
                          const std::string& start) {
  return fmt::format(
      "[time]\nduration = {}\nstep = {}\noutput_interval = 0.05\n"
      "integrator = \"runge-kutta-4\"\n"
      "[gravity]\nacceleration = [0.5, -1.0, -9.81]\n[initial.joints]\n{}",
      duration, step, start);
}

std::string make_start(std::mt19937& random) {
  std::uniform_real_distribution<double> angle(-1.5, 1.5);
  std::uniform_real_distribution<double> speed(-4.0, 4.0);
  const auto two = [&](auto& d) {
    return fmt::format("[{:.9f}, {:.9f}]", d(random), d(random));
  };
  const auto three = [&](auto& d) {
    return fmt::format("[{:.9f}, {:.9f}, {:.9f}]", d(random), d(random),
                       d(random));
  };
  return fmt::format(
      "cross = {{ position = {}, velocity = {} }}\n"
      "socket = {{ position = {}, velocity = {} }}\n",
      two(angle), two(speed), three(angle), three(speed));
}

Snapshot start_of(const RigidScene& scene, JointModel joints) {
  return simulate(make_mechanism(scene.scene, scene.built), {joints, 1e-6},
                  {{1e-6, false, true}})
      .snapshots.front();
}

TEST(SimbodyReference,
     StartsUniversalAndBallJointsAsWeDoAtRandomAnglesAndRates) {
  std::mt19937 random(7);
  for (int i = 0; i < 10; ++i) {
    const RigidScene scene(make_robot(kStiff, kStiff),
                           make_scenario(0.1, 1e-3, make_start(random)));
    for (const JointModel joints : {JointModel::bushings, JointModel::ideal}) {
      const Agreement agreement = compare(
          {start_of(scene, joints)}, {scene.built.initial},
          {dynamics::calc_energy(scene.built.model, scene.built.initial)});
      EXPECT_LT(agreement.largest.position, 1e-13);
      EXPECT_LT(agreement.largest.rotation, 1e-13);
      EXPECT_LT(agreement.largest.velocity, 1e-13);
      EXPECT_LT(agreement.largest.angular_velocity, 1e-13);
      EXPECT_LT(agreement.energy, 1e-12);
    }
  }
}

// So soft that they are pulled far apart: their forces and energies agree
// where they are large.
TEST(Verify, HoldsAndSpringsOfUniversalAndBallJointsAreTheSameLaws) {
  const std::string soft =
      R"(translational_stiffness="60" rotational_stiffness="3"
         translational_damping="0.8" rotational_damping="0.05"
         free_damping="0.03">)";
  std::mt19937 random(3);
  const RigidScene scene(
      make_robot(soft + R"(<spring coordinate="1" stiffness="2" rest="0.3"/>
                          <spring coordinate="2" stiffness="1" damping="0.04"/>
                          <friction coordinate="2" viscous="0.05"/>)",
                 soft + R"(<spring coordinate="3" stiffness="0.4"/>)"),
      make_scenario(0.4, 4e-3, make_start(random)));
  const Verification result =
      verify(scene.scene, scene.built, {{JointModel::bushings, 1e-12}, 3});
  std::vector<double> relative;
  for (const Agreement& run : result.runs) {
    relative.push_back(find_relative(run.largest, result.motion));
  }
  EXPECT_NEAR(std::log2(relative[1] / relative[2]), 4.0, 0.3);
  EXPECT_NEAR(std::log2(relative[2] / relative[3]), 4.0, 0.3);
  EXPECT_LT(relative[3], 1e-8);
  EXPECT_LT(result.runs[3].energy, 1e-8 * result.energy);
}

TEST(Verify, RefusesByNameWhatActsInJointsButLinearSpringsAndViscosity) {
  const auto message = [](const std::string& acting) {
    const RigidScene scene(make_robot(kStiff + acting, kStiff),
                           make_scenario(0.1, 1e-3, ""));
    try {
      (void)make_mechanism(scene.scene, scene.built);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(message(R"(<spring coordinate="1" stiffness="2"/>)"), "");
  EXPECT_THAT(message(R"(<spring coordinate="1" quadratic="2"/>)"),
              HasSubstr("'cross' has a spring that is not linear"));
  EXPECT_THAT(message(R"(<friction coordinate="1" coulomb="2"/>)"),
              HasSubstr("'cross' has Coulomb friction"));
  EXPECT_THAT(message(R"(<stop coordinate="1" lower="-1" upper="1"/>)"),
              HasSubstr("'cross' has stops or drives"));
}

TEST(Verify, HasNoLinearBushingForAUniversalJoint) {
  const RigidScene scene(make_robot(kStiff, kStiff),
                         make_scenario(0.1, 1e-3, ""));
  EXPECT_THROW((void)start_of(scene, JointModel::linear_bushings), InputError);
}

// A pointer that turns on a pin far enough to wind its spring up, over its
// weight.
TEST(Verify, StopsWhereASpringIsWoundByHalfATurn) {
  const RigidScene scene(
      "<robot name=\"clock\"><link name=\"world\"/>" + make_link("hand", 1.0) +
          make_joint("pin", "continuous", "world", "hand", "0 0 1") +
          R"(<coupler joint="pin"><spring stiffness="1e-3"/></coupler></robot>)",
      make_scenario(1.0, 1e-3, "pin = { velocity = 15.0 }\n"));
  const auto run = [&] {
    (void)verify(scene.scene, scene.built, {{JointModel::ideal, 1e-8}, 0});
  };
  // Not by our own run, which a spring may wind up.
  EXPECT_THAT(run, ThrowsMessage<NumericalError>(HasSubstr("Simbody")));
}

}  // namespace
}  // namespace limber::reference::joint_test
