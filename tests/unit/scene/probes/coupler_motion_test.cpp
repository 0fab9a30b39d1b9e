// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "limber/dynamics/equations/energy.hpp"
#include "unit/scene/scene_folder.hpp"

/// Scenes of rigid links with each kind of coupler, against closed forms.
namespace limber::scene::coupler_motion_test {
namespace {

using test::kWorld;
using test::rigid_link;
using test::SceneFolder;
using test::simulate_probes;
using test::time_table;

constexpr double kPi = std::numbers::pi;

std::string joint(const std::string& name, const std::string& child,
                  const std::string& type = "continuous",
                  const std::string& more = "",
                  const std::string& parent = "world") {
  return fmt::format(
      "<joint name='{}' type='{}'><parent link='{}'/><child link='{}'/>"
      "<axis xyz='0 0 1'/><limit effort='0' velocity='0'/>{}</joint>\n",
      name, type, parent, child, more);
}

std::string probe(const std::string& link, const std::string& quantity,
                  const std::string& more = "") {
  return fmt::format(
      "[[probe]]\nname = '{0}{1}'\nlink = '{0}'\nquantity = '{1}'\n{2}\n", link,
      quantity, more);
}

std::string start(const std::string& joint, const std::string& what) {
  return "[initial.joints." + joint + "]\n" + what + "\n";
}

// I q'' = -k q, linear up to any angle: q = 2 cos(w t).
TEST(CouplerMotion, SpringAboutAHingeSwingsAtItsFrequencyThroughLargeAngles) {
  const SceneFolder folder;
  const double omega = std::sqrt(40.0 / 0.1);
  const double step = 1e-4;
  const double angle = 2.25 * 2.0 * kPi;
  const auto end = simulate_probes(folder.build(
      kWorld + rigid_link("a", 2.0, 0.1) + joint("j", "a") +
          "<coupler joint='j'><spring stiffness='40'/></coupler>",
      time_table(angle / omega, step) + start("j", "position = 2.0") +
          probe("a", "position", "point = [1.0, 0.0, 0.0]")));
  // The integrator's phase: of second order in a step's angle.
  const double tolerance = 2.0 * angle * 0.5 * std::pow(omega * step, 2);
  EXPECT_NEAR(end[1], 0.0, tolerance);
  EXPECT_NEAR(end[0], 1.0, tolerance);
}

TEST(CouplerMotion, HingeLeavesItsStopAtTheGivenRestitution) {
  const SceneFolder folder;
  const auto end = simulate_probes(
      folder.build(kWorld + rigid_link("a", 2.0, 0.1) + joint("j", "a") +
                       "<coupler joint='j'><stop upper='0.1' stiffness='100' "
                       "restitution='0.5' speed='2'/></coupler>",
                   time_table(0.5, 1e-4) + start("j", "velocity = 2.0") +
                       probe("a", "angular_velocity")));
  EXPECT_NEAR(end[2], -1.0, 1e-4);  // of the integrator: (omega step)^2 = 1e-5
}

// I w' = -Fc except for vs^2 / 2 w^2 of it.
TEST(CouplerMotion, FrictionOfUrdfSlowsAHingeEvenly) {
  const SceneFolder folder;
  const auto end = simulate_probes(folder.build(
      kWorld + rigid_link("a", 2.0, 0.1) +
          joint("j", "a", "continuous", "<dynamics friction='0.2'/>"),
      time_table(1.0, 1e-3) + start("j", "velocity = 3.0") +
          probe("a", "angular_velocity")));
  EXPECT_NEAR(end[2], 1.0, 1e-6);
}

// (I_a + I_b / r^2) w_a' = moment, r = 3.
TEST(CouplerMotion, GearedHingesTurnInTheirRatio) {
  const SceneFolder folder;
  const auto end = simulate_probes(folder.build(
      kWorld + rigid_link("a", 2.0, 0.1) + rigid_link("b", 2.0, 0.3) +
          joint("j", "a") + joint("k", "b") +
          "<gear name='g' joint='j' with='k' ratio='3'/>",
      time_table(1.0, 1e-3) +
          "[[load]]\nname = 'm'\nlink = 'a'\nmoment = [0.0, 0.0, 0.4]\n"
          "time = { kind = 'constant' }\n" +
          probe("a", "angular_velocity") + probe("b", "angular_velocity")));
  const double rate = 0.4 / (0.1 + 0.3 / 9.0);
  EXPECT_NEAR(end[2], rate, 1e-5);
  EXPECT_NEAR(end[5], rate / 3.0, 1e-5);
}

const std::string kGravity = "[gravity]\nacceleration = [0.0, 0.0, -9.81]\n";
const std::string kPulley =
    "<via link='a'/><via link='world' point='0 0 10'/>"
    "<via link='world' point='5 0 10'/></tendon>";

// m z'' = T - m g
TEST(CouplerMotion, TendonOverAPulleyLiftsAMass) {
  const SceneFolder folder;
  const auto end = simulate_probes(folder.build(
      kWorld + rigid_link("a", 2.0, 0.1) + joint("j", "a", "prismatic") +
          "<tendon name='t' tension='23.62'>" + kPulley,
      time_table(1.0, 1e-2) + kGravity + probe("a", "position")));
  EXPECT_NEAR(end[2], 1.0, 1e-9);
}

TEST(CouplerMotion, PretensionOfATendonHoldsAWeight) {
  const SceneFolder folder;
  const auto end = simulate_probes(folder.build(
      kWorld + rigid_link("a", 2.0, 0.1) + joint("j", "a", "prismatic") +
          "<tendon name='t' stiffness='100' pretension='19.62'>" + kPulley,
      time_table(1.0, 1e-2) + kGravity + probe("a", "position")));
  EXPECT_NEAR(end[2], 0.0, 1e-12);
}

struct Catch {
  double linear = 0.0;          ///< change of momentum [kg m/s]
  double angular = 0.0;         ///< of angular momentum [kg m^2/s]
  joints::CouplerMemory latch;  ///< at the end
  std::vector<double> rates;    ///< of a and b at the end [rad/s]
};

/// Body a comes with 1 m/s and is caught by b off the line between the centres.
Catch catch_off_centre(double step) {
  const SceneFolder folder;
  const BuiltScene built = folder.build(
      kWorld + rigid_link("a", 1.0, 0.1) + rigid_link("b", 3.0, 0.3) +
          joint("j", "a", "floating") + joint("k", "b", "floating") +
          "<latch name='l' from='a' to='b' reach='0.5' "
          "translational_stiffness='1e4' translational_damping='60' "
          "rotational_stiffness='1e3' rotational_damping='3'/>",
      time_table(1.5, step) +
          start("j", "velocity = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0]") +
          start("k", "position = [1.0, 0.3, 0.0, 0.0, 0.0, 0.0]") +
          probe("a", "angular_velocity") + probe("b", "angular_velocity"));
  dynamics::SystemState state = built.initial;
  std::vector<dynamics::EnergyBalance> all;
  dynamics::simulate(built.model, state, built.settings,
                     [&](const auto&, const auto& now) { all.push_back(now); });
  return {(all.back().linear_momentum - all.front().linear_momentum).norm(),
          (all.back().angular_momentum - all.front().angular_momentum).norm(),
          state.memory.at(0), evaluate_all(built.probes, built.model, state)};
}

// In the end both turn as one body about their common centre, with what the
// angular momentum leaves. At the catch b is (0.4, 0.3) from a.
TEST(CouplerMotion, LatchCatchesAndKeepsBothMomenta) {
  const Catch coarse = catch_off_centre(1e-3);
  const Catch fine = catch_off_centre(5e-4);
  EXPECT_LT(coarse.linear, 1e-12);
  EXPECT_GT(coarse.angular, 3.5 * fine.angular);  // of second order
  EXPECT_LT(fine.angular, 1e-5);
  EXPECT_EQ(fine.latch.latch, joints::LatchStatus::closed);
  EXPECT_NEAR(fine.latch.X_FM.p.norm(), 0.5, 1e-9);
  const double mu = 0.75;
  const double rate = mu * 0.3 / (0.1 + 0.3 + mu * 0.25);
  // The latch stretches by mu rate^2 0.5 / k: 6e-6 m.
  EXPECT_NEAR(fine.rates[2], rate, 2e-5);
  EXPECT_NEAR(fine.rates[5], rate, 2e-5);
}

// A parallelogram without gravity turns at a constant rate: its bar does not
// turn, and every point of it goes round a circle.
TEST(CouplerMotion, LoopKeepsAFourBarClosed) {
  const SceneFolder folder;
  const auto end = simulate_probes(folder.build(
      kWorld + rigid_link("left", 1.0, 0.1, "0 0.5 0") +
          rigid_link("bar", 2.0, 0.3, "1 0 0") +
          rigid_link("right", 1.0, 0.1, "0 0.5 0") + joint("a", "left") +
          joint("b", "bar", "continuous", "<origin xyz='0 1 0'/>", "left") +
          joint("c", "right", "continuous", "<origin xyz='2 0 0'/>") +
          "<loop name='d' kind='revolute' axis='0 0 1'>"
          "<from link='bar' point='2 0 0'/><to link='right' point='0 1 0'/>"
          "</loop>",
      time_table(1.0, 1e-3) + start("a", "velocity = 1.0") +
          start("b", "velocity = -1.0") + start("c", "velocity = 1.0") +
          probe("bar", "rotation") +
          probe("bar", "position", "point = [2.0, 0.0, 0.0]") +
          probe("right", "position", "point = [0.0, 1.0, 0.0]")));
  const double kCompliance = 1e-6;  // oscillation, 2 N over mu (2 pi 1000 Hz)^2
  EXPECT_NEAR(end[2], 0.0, kCompliance);
  EXPECT_NEAR(end[3], 2.0 - std::sin(1.0), 2e-6);
  EXPECT_NEAR(end[4], std::cos(1.0), 2e-6);
  EXPECT_NEAR(end[6], end[3], kCompliance);
  EXPECT_NEAR(end[7], end[4], kCompliance);
}

}  // namespace
}  // namespace limber::scene::coupler_motion_test
