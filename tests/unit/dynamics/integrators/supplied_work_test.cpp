// SPDX-License-Identifier: BSD-3-Clause
// Work of drives, loads and weight in steps far longer than what they follow.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "limber/common/rotation.hpp"
#include "support/sliding_masses.hpp"

namespace limber::dynamics::supplied_work_test {
namespace {

using testing::run_from;
using testing::RunOutcome;

constexpr double kMass = 2.0;
constexpr double kEffort = 8.0;

SimulationSettings make_settings(double step, double end = 0.99) {
  SimulationSettings settings;
  settings.end_time = end;
  settings.step = step;
  settings.rho_inf = 0.9;
  for (int i = 0; i < 33; ++i) settings.output_times.push_back(end * i / 33.0);
  settings.output_times.push_back(end);
  return settings;
}

joints::Drive::Parameters make_sine_drive(joints::DriveMode mode, double mean,
                                          double frequency) {
  joints::Drive::Parameters drive;
  drive.mode = mode;
  drive.signal.base = joints::SineSignal{
      .mean = mean, .amplitude = 0.3, .frequency = frequency};
  drive.stiffness = 200.0;
  drive.damping = mode == joints::DriveMode::velocity ? 1e4 : 0.5;
  drive.max_effort = kEffort;
  return drive;
}

RunOutcome run_drives(const std::vector<joints::Drive::Parameters>& drives,
                      const SimulationSettings& settings) {
  SystemBuilder builder;
  for (std::size_t i = 0; i < drives.size(); ++i) {
    const std::string name = "sledge" + std::to_string(i);
    const testing::Mass mass = testing::add_mass(builder, name, kMass);
    testing::add_rail(builder, mass, "rail" + std::to_string(i),
                      {{0, joints::Drive(drives[i])}});
  }
  const SystemModel model = builder.build();
  return run_from(model, make_state(model), settings);
}

// F (s_1 - s_0) of a position drive far from its command.
double find_work(double sign, double frequency, double t) {
  const double w = 2.0 * std::numbers::pi * frequency;
  return sign * kEffort * 0.3 * std::sin(w * t);
}

TEST(SuppliedWork, OfASaturatedDriveIsItsEffortTimesTheCommandsPath) {
  for (const double frequency : {0.1, 1.0, 5.0, 100.0}) {
    for (const double mean : {5.0, -5.0}) {
      for (const double step : {0.03, 0.01, 1e-3}) {
        const RunOutcome r = run_drives(
            {make_sine_drive(joints::DriveMode::position, mean, frequency)},
            make_settings(step));
        for (std::size_t i = 0; i < r.states.size(); ++i) {
          EXPECT_NEAR(
              r.energies[i].work,
              find_work(std::copysign(1.0, mean), frequency, r.states[i].t),
              1e-9)
              << frequency << ' ' << step;
        }
      }
    }
  }
}

TEST(SuppliedWork, OfTwoDrivesIsTheSum) {
  const RunOutcome r =
      run_drives({make_sine_drive(joints::DriveMode::position, 5.0, 7.0),
                  make_sine_drive(joints::DriveMode::position, -5.0, 3.0)},
                 make_settings(0.03));
  EXPECT_NEAR(r.energies.back().work,
              find_work(1.0, 7.0, 0.99) + find_work(-1.0, 3.0, 0.99), 1e-9);
}

// The commanded speed's integral: mean t - 0.3 (cos(w t) - 1) / w.
TEST(SuppliedWork, OfASaturatedVelocityDriveGoesByTheIntegralOfItsCommand) {
  const double frequency = 40.0;
  const RunOutcome r = run_drives(
      {make_sine_drive(joints::DriveMode::velocity, 50.0, frequency)},
      make_settings(0.03));
  const double w = 2.0 * std::numbers::pi * frequency;
  const double path = 50.0 * 0.99 - 0.3 * (std::cos(w * 0.99) - 1.0) / w;
  EXPECT_NEAR(r.energies.back().work, kEffort * path, 1e-9);
}

// A swinging bar under a force in the world's axes and its weight.
TEST(SuppliedWork, OfForcesInTheWorldIsTheirDisplacement) {
  const Vector3 force(3.0, -1.0, 4.0);
  SystemBuilder builder;
  builder.set_gravity({0.0, 0.0, -9.81});
  const BodyIndex bar = builder.add_rigid_body(
      "bar", {kMass, Matrix3(Vector3(0.1, 0.7, 0.7).asDiagonal())});
  builder.add_coupler(
      "pivot",
      joints::make_joint(joints::JointKind::ball, Vector3::UnitX(),
                         Vector3::UnitY(),
                         {.translational_stiffness = 1e6,
                          .rotational_stiffness = 1e6,
                          .translational_damping = 1.0,
                          .rotational_damping = 1.0}),
      builder.attach_world("pin", {}),
      builder.attach_frame("end", bar, {Matrix3::Identity(), {-1, 0, 0}}));
  const auto tip =
      builder.attach_frame("tip", bar, {Matrix3::Identity(), {1, 0.2, 0}});
  builder.add_load("pull", tip, force, Vector3::Zero(), LoadFrame::world,
                   Constant{});
  const SystemModel model = builder.build();
  SystemState start = make_state(model);
  start.bodies[0].p_WB = {1, 0, 0};
  SimulationSettings settings = make_settings(0.01);
  settings.newton_tolerance = 1e-14;  // powers are those of an iterate
  const RunOutcome r = run_from(model, start, settings);
  const auto potential = [&](const SystemState& state) {
    return force.dot(find_frame_motion(model, state, tip).X_WF.p) -
           kMass * 9.81 * state.bodies[0].p_WB.z();
  };
  for (std::size_t i = 0; i < r.states.size(); ++i) {
    EXPECT_NEAR(r.energies[i].work, potential(r.states[i]) - potential(start),
                1e-8)
        << i;
  }
  EXPECT_GT(r.energies.back().work, 1.0);
}

// A wheel on a torsion spring that the steps hardly resolve: moments in both
// axes do M theta.
TEST(SuppliedWork, OfAMomentAboutAFixedAxisIsItsAngle) {
  constexpr double kMoment = 3.0;
  for (const LoadFrame frame : {LoadFrame::world, LoadFrame::body}) {
    SystemBuilder builder;
    const testing::Mass wheel = testing::add_mass(builder, "wheel", kMass);
    testing::add_shaft(builder, wheel, "shaft",
                       {{0, joints::ScalarSpring({.curve = joints::SpringCurve(
                                                      {.stiffness = 8.0})})}});
    builder.add_load("twist", wheel.frame, Vector3::Zero(), {0.0, 0.0, kMoment},
                     frame, Constant{});
    const SystemModel model = builder.build();
    SimulationSettings settings = make_settings(0.03);
    settings.newton_tolerance = 1e-14;  // powers are those of an iterate
    const RunOutcome r = run_from(model, make_state(model), settings);
    double farthest = 0.0;
    for (std::size_t i = 0; i < r.states.size(); ++i) {
      const Vector3 angle = log_rotation(r.states[i].bodies[0].quat_WB);
      EXPECT_NEAR(r.energies[i].work, kMoment * angle.z(), 1e-8) << i;
      farthest = std::max(farthest, angle.z());
    }
    EXPECT_GT(farthest, 0.3);
  }
}

// 3 t on 2 kg: v = 3 t^2 / 2 m, W = 9 t^4 / 8 m.
double find_error_under_linear_force(double step) {
  SystemBuilder builder;
  const testing::Mass mass = testing::add_mass(builder, "mass", kMass);
  builder.add_load("push", mass.frame, {1.0, 0, 0}, Vector3::Zero(),
                   LoadFrame::world, Table{{0.0, 10.0}, {0.0, 30.0}});
  const SystemModel model = builder.build();
  const RunOutcome r =
      run_from(model, make_state(model), make_settings(step, 1.0));
  return r.energies.back().work - 9.0 / (8.0 * kMass);
}

TEST(SuppliedWork, OfAForceLinearInTimeIsOfSecondOrder) {
  const double coarse = find_error_under_linear_force(0.02);
  const double fine = find_error_under_linear_force(0.01);
  EXPECT_LT(std::abs(coarse), 1e-3);
  EXPECT_NEAR(coarse / fine, 4.0, 0.3);
}

}  // namespace
}  // namespace limber::dynamics::supplied_work_test
