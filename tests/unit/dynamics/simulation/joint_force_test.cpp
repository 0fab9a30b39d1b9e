// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "limber/dynamics/analysis/equilibrium.hpp"
#include "limber/dynamics/analysis/natural_frequencies.hpp"
#include "limber/dynamics/analysis/steady_spin.hpp"
#include "limber/dynamics/equations/coupler_motion.hpp"
#include "limber/dynamics/equations/joint_state.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/system/system_builder.hpp"

/// Forces of joints from the start on, in rotation, at rest and within steps,
/// against closed forms.
namespace limber::dynamics::joint_force_test {
namespace {

using joints::JointKind;

constexpr double kMass = 2.5;    // of a rod [kg]
constexpr double kLength = 1.2;  // [m]
constexpr double kGravity = 9.81;
constexpr double kSpin = 7.0;       // [rad/s]
constexpr double kStiffness = 1e9;  // [N/m, N m/rad]
const JointOptions kIdeal{.held = {.is_ideal = true}};
const JointOptions kStiff{.held = {.translational_stiffness = kStiffness,
                                   .rotational_stiffness = kStiffness}};

struct Scene {
  SystemModel model;
  SystemState state;
};

// Rods along x, each on a hinge about y, the first at the origin.
SystemModel make_rods(int count, const JointOptions& joint,
                      const Vector3& gravity, double scale = 1.0) {
  const double I = scale * kMass * kLength * kLength / 12.0;
  SystemBuilder builder;
  BodyIndex last = kWorld;
  for (int i = 0; i < count; ++i) {
    const BodyIndex rod = builder.add_rigid_body(
        fmt::format("rod_{}", i),
        {scale * kMass, Vector3(1e-3 * I, I, I).asDiagonal()});
    const Vector3 parent(i == 0 ? 0.0 : kLength / 2.0, 0.0, 0.0);
    builder.add_joint(
        fmt::format("hinge_{}", i), JointKind::revolute,
        {last, Pose{Matrix3::Identity(), parent}},
        {rod, Pose{Matrix3::Identity(), Vector3(-kLength / 2.0, 0.0, 0.0)}},
        Vector3::UnitY(), joint);
    last = rod;
  }
  builder.set_gravity(gravity);
  return builder.build();
}

Scene make_scene(int count, const JointOptions& joint, const Vector3& gravity,
                 const JointStates& start, double scale = 1.0) {
  SystemModel model = make_rods(count, joint, gravity, scale);
  SystemState state = make_state(model, start);
  return {std::move(model), std::move(state)};
}

struct Sample {
  double t = 0.0;
  Vector3 force = Vector3::Zero();  // of the first hinge on its rod, world [N]
};

std::vector<Sample> run(const Scene& scene, const SimulationSettings& given,
                        double interval) {
  SimulationSettings settings = given;
  for (int i = 0; i * interval <= settings.end_time * (1.0 + 1e-9); ++i) {
    settings.output_times.push_back(std::min(i * interval, settings.end_time));
  }
  std::vector<Sample> samples;
  SystemState state = scene.state;
  simulate(scene.model, state, settings,
           [&](const SystemState& at, const EnergyBalance&) {
             const CouplerReading reading =
                 evaluate_coupler(scene.model, at, CouplerIndex(0));
             samples.push_back(
                 {at.t, reading.R_WF * reading.response.wrench.head<3>()});
           });
  return samples;
}

SimulationSettings make_settings(double step, double end) {
  SimulationSettings settings;
  settings.step = step;
  settings.end_time = end;
  return settings;
}

// The largest distance of the magnitude from the expected one.
double find_error(const std::vector<Sample>& samples, double expected) {
  double largest = 0.0;
  for (const Sample& sample : samples) {
    largest = std::max(largest, std::abs(sample.force.norm() - expected));
  }
  return largest;
}

TEST(JointForces, OfASpinningRodAreCentripetalFromTheStart) {
  const double expected = kMass * kSpin * kSpin * kLength / 2.0;
  for (const double step : {1e-3, 2.5e-4}) {
    for (const double scale : {1.0, 1e3}) {
      const Scene scene = make_scene(1, kIdeal, Vector3::Zero(),
                                     {{"hinge_0", {{0.3}, {kSpin}}}}, scale);
      const std::vector<Sample> samples =
          run(scene, make_settings(step, 0.05), step);
      EXPECT_LT(find_error(samples, scale * expected),
                20.0 * step * step * kSpin * kSpin * scale * expected)
          << step << " " << scale;
      EXPECT_EQ(samples.size(), std::lround(0.05 / step) + 1);
    }
  }
}

TEST(JointForces, OfAStiffJointInSteadyRotationAreConstant) {
  const double expected = kMass * kSpin * kSpin * kLength / 2.0;
  Scene scene =
      make_scene(1, kStiff, Vector3::Zero(), {{"hinge_0", {{0.3}, {kSpin}}}});
  scene.state = find_steady_spin(scene.model, scene.state);
  for (const double step : {2e-3, 1e-3, 1e-4}) {
    EXPECT_LT(find_error(run(scene, make_settings(step, 0.05), step), expected),
              3e-3 * expected)
        << step;
  }
}

// In place of an exact solution, steps of a sixteenth. The first steps have
// an error of first order, which rho_inf damps.
TEST(JointForces, OfAFallingChainConvergeFromTheFirstStepOn) {
  for (const bool is_moving : {false, true}) {
    const double rate = is_moving ? 1.0 : 0.0;
    const Scene scene = make_scene(3, kIdeal, {0.0, 0.0, -kGravity},
                                   {{"hinge_0", {{0.2}, {3.0 * rate}}},
                                    {"hinge_1", {{-0.5}, {-4.0 * rate}}},
                                    {"hinge_2", {{0.7}, {5.0 * rate}}}});
    constexpr double kStep = 1e-3;
    const std::vector<Sample> fine =
        run(scene, make_settings(kStep / 16.0, 0.04), kStep);
    std::vector<double> errors;
    for (const double step : {kStep, kStep / 2.0}) {
      const std::vector<Sample> coarse =
          run(scene, make_settings(step, 0.04), kStep);
      ASSERT_EQ(coarse.size(), fine.size());
      double error = 0.0;
      for (std::size_t i = 0; i < fine.size(); ++i) {
        error = std::max(error, (coarse[i].force - fine[i].force).norm());
      }
      errors.push_back(error);
    }
    EXPECT_LT(errors[0], 0.03 * kMass * kGravity) << is_moving;
    EXPECT_GT(errors[0] / errors[1], 1.7) << is_moving;
  }
}

TEST(JointForces, AtAnEquilibriumBalanceTheWeightThereAndInARun) {
  const double weight = 2.0 * kMass * kGravity;
  Scene scene =
      make_scene(2, kIdeal, {0.0, 0.0, -kGravity}, {{"hinge_0", {{1.5}, {}}}});
  scene.state = find_equilibrium(scene.model, scene.state).state;
  const CouplerReading reading =
      evaluate_coupler(scene.model, scene.state, CouplerIndex(0));
  EXPECT_LT((reading.R_WF * reading.response.wrench.head<3>() -
             Vector3(0.0, 0.0, weight))
                .norm(),
            1e-9 * weight);
  for (const IntegratorKind kind :
       {IntegratorKind::generalized_alpha, IntegratorKind::energy_conserving,
        IntegratorKind::implicit_euler}) {
    SimulationSettings settings = make_settings(1e-3, 0.1);
    settings.integrator = kind;
    EXPECT_LT(find_error(run(scene, settings, 1e-2), weight), 1e-7 * weight)
        << to_string(kind);
  }
}

TEST(JointForces, OfAHangingDoublePendulumGiveItsFrequencies) {
  // Of angles from the vertical, small.
  Scene scene = make_scene(2, kIdeal, {0.0, 0.0, -kGravity},
                           {{"hinge_0", {{std::numbers::pi / 2.0}, {0.0}}}});
  SystemState state = scene.state;
  simulate(scene.model, state, make_settings(1e-3, 0.05), {});
  const double L2 = kMass * kLength * kLength;
  Eigen::Matrix2d M;
  M << 4.0 / 3.0 * L2, 0.5 * L2, 0.5 * L2, 1.0 / 3.0 * L2;
  const Eigen::Vector2d K =
      kMass * kGravity * kLength * Eigen::Vector2d(1.5, 0.5);
  const Eigen::Matrix2d A = M.inverse() * Eigen::Matrix2d(K.asDiagonal());
  const double half = 0.5 * A.trace();
  const double root = std::sqrt(half * half - A.determinant());
  const VectorX f = find_natural_frequencies(scene.model, state);
  EXPECT_NEAR(2.0 * std::numbers::pi * f[0], std::sqrt(half - root), 1e-5);
  EXPECT_NEAR(2.0 * std::numbers::pi * f[1], std::sqrt(half + root), 1e-5);
}

// In place of an exact solution, fine fixed steps. Where steps change in length
// the forces swing by a tenth; those of interpolated places would be many times
// too large.
TEST(JointForces, AtOutputsWithinStepsAreThoseOfTheStepsEnds) {
  for (const JointOptions& joint : {kIdeal, kStiff}) {
    const Scene scene =
        make_scene(2, joint, {0.0, 0.0, -kGravity},
                   {{"hinge_0", {{0.2}, {0.0}}}, {"hinge_1", {{0.4}, {0.0}}}});
    constexpr double kInterval = 1.37e-3;
    SimulationSettings free = make_settings(1.0, 0.5);
    free.tolerance = 1e-5 * kLength;
    const std::vector<Sample> samples = run(scene, free, kInterval);
    const std::vector<Sample> fine =
        run(scene, make_settings(kInterval / 16.0, 0.5), kInterval);
    ASSERT_EQ(samples.size(), fine.size());
    double error = 0.0;
    double largest = 0.0;
    for (std::size_t i = 0; i < fine.size(); ++i) {
      error = std::max(error, (samples[i].force - fine[i].force).norm());
      largest = std::max(largest, fine[i].force.norm());
    }
    EXPECT_LT(error, 0.15 * largest) << joint.held.is_ideal.has_value();
  }
}

TEST(JointForces, AtOutputsWithinStepsFollowAJumpOfTheLoad) {
  for (const JointOptions& joint : {kIdeal, kStiff}) {
    SystemBuilder builder;
    const BodyIndex block = builder.add_rigid_body(
        "block", {kMass, Vector3(0.1, 0.2, 0.3).asDiagonal()});
    builder.add_joint("weld", JointKind::fixed, {}, {block}, Vector3::UnitZ(),
                      joint);
    builder.add_load("pull", builder.attach_frame("at", block, Pose()),
                     Vector3(0.0, 0.0, -100.0), Vector3::Zero(),
                     LoadFrame::world,
                     StepSequence{.times = {0.05, 0.06}, .values = {1.0, 0.0}});
    builder.set_gravity({0.0, 0.0, -kGravity});
    Scene scene{builder.build(), {}};
    scene.state = make_state(scene.model);
    SimulationSettings free = make_settings(1.0, 0.1);
    free.tolerance = 1e-6;
    for (const Sample& sample : run(scene, free, 0.7e-3)) {
      const bool is_pulled = sample.t > 0.05 && sample.t <= 0.06;
      // A stiff joint rings.
      const double ringing = joint.held.is_ideal ? 1e-6 : 150.0;
      EXPECT_NEAR(sample.force.z(),
                  kMass * kGravity + (is_pulled ? 100.0 : 0.0), ringing)
          << sample.t;
    }
  }
}

}  // namespace
}  // namespace limber::dynamics::joint_force_test
