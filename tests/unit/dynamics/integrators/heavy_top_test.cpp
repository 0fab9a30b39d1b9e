// SPDX-License-Identifier: BSD-3-Clause
#include "support/heavy_top.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <ostream>
#include <vector>

#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/system/system_builder.hpp"

/// Heavy symmetric tops by our integrators against elliptic functions.
namespace limber::dynamics::heavy_top_test {
namespace {

constexpr double kI1 = 0.012;     // [kg m^2]
constexpr double kI3 = 0.004;     // [kg m^2]
constexpr double kArm = 0.1;      // [m]
constexpr double kWeight = 9.81;  // [N]
constexpr double kTilt = 0.5;     // [rad]

/// A body that floats: a weight fixed in the world pulls at a point of its
/// axis. Its centre of mass falls, and about it the body turns as a top on a
/// fixed point does, whose inertia I1 is about that point.
SystemModel make_top() {
  SystemBuilder builder;
  const auto body = builder.add_rigid_body(
      "top", {1.0, Matrix3(Vector3(kI1, kI1, kI3).asDiagonal())});
  const auto where =
      builder.attach_frame("load", body, {Matrix3::Identity(), {0, 0, kArm}});
  builder.add_load("weight", where, {0, 0, -kWeight}, Vector3::Zero(),
                   LoadFrame::world, Constant{});
  return builder.build();
}

std::vector<SystemState> run(double spin, IntegratorKind kind, double step,
                             const std::vector<double>& times) {
  const SystemModel model = make_top();
  SystemState state = make_state(model);
  state.bodies[0].quat_WB = Eigen::AngleAxisd(kTilt, Vector3::UnitX());
  state.bodies[0].w_WB_B = {0, 0, spin};
  SimulationSettings settings;
  settings.integrator = kind;
  settings.end_time = times.back();
  settings.step = step;
  settings.output_times = times;
  settings.rho_inf = 1.0;
  std::vector<SystemState> states;
  simulate(model, state, settings,
           [&](const SystemState& now, const auto&) { states.push_back(now); });
  return states;
}

Vector3 find_axis(const SystemState& state) {
  return state.bodies[0].quat_WB.toRotationMatrix().col(2);
}

testing::HeavyTop closed_form(double spin) {
  return {kI1, kI3, kWeight * kArm, spin, kTilt};
}

// Small nutation of a fast top: period 2 pi I1 / (I3 w3), drift m g l /
// (I3 w3), both to first order in torque I1 / (I3 w3)^2.
TEST(HeavyTopClosedForm, TendsToTheFastTop) {
  for (const double spin : {1e3, 1e4}) {
    const testing::HeavyTop top = closed_form(spin);
    const double momentum = kI3 * spin;
    const double small = kWeight * kArm * kI1 / (momentum * momentum);
    const double period = 2.0 * std::numbers::pi * kI1 / momentum;
    EXPECT_NEAR(top.nutation_period() / period, 1.0, 4.0 * small);
    EXPECT_NEAR(top.precession() / (kWeight * kArm / momentum * period), 1.0,
                4.0 * small);
  }
}

// A slow top that swings far down, a middling and a fast one.
class HeavyTopSpin : public ::testing::TestWithParam<double> {};

TEST_P(HeavyTopSpin, NutatesByEllipticFunctionsToNineDigits) {
  const testing::HeavyTop top = closed_form(GetParam());
  const double period = top.nutation_period();
  std::vector<double> times;
  for (int i = 0; i <= 200; ++i) times.push_back(period * i / 40.0);
  const double step = std::min(period, 6.28 / GetParam()) / 2000.0;
  const auto states =
      run(GetParam(), IntegratorKind::runge_kutta_4, step, times);
  for (std::size_t i = 0; i < times.size(); ++i) {
    EXPECT_NEAR(find_axis(states[i])[2], top.cosine(times[i]), 1e-9);
    EXPECT_NEAR(states[i].bodies[0].w_WB_B[2], GetParam(), 1e-13 * GetParam());
  }
}

TEST_P(HeavyTopSpin, PrecessesByTheQuadratureToNineDigits) {
  const testing::HeavyTop top = closed_form(GetParam());
  const double period = top.nutation_period();
  std::vector<double> times;
  for (int i = 0; i <= 5; ++i) times.push_back(period * i);
  const double step = std::min(period, 6.28 / GetParam()) / 2000.0;
  const auto states =
      run(GetParam(), IntegratorKind::runge_kutta_4, step, times);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const Vector3 axis = find_axis(states[i]);
    const Vector3 first = find_axis(states[0]);
    const double angle = std::atan2(first[0] * axis[1] - first[1] * axis[0],
                                    first[0] * axis[0] + first[1] * axis[1]);
    const double expected = static_cast<double>(i) * top.precession();
    EXPECT_NEAR(std::remainder(angle - expected, 2.0 * std::numbers::pi), 0.0,
                1e-9)
        << i;
  }
}

INSTANTIATE_TEST_SUITE_P(All, HeavyTopSpin,
                         ::testing::Values(20.0, 60.0, 400.0));

struct Scheme {
  IntegratorKind kind;
  double order;
  double step;  ///< [s]
};

void PrintTo(const Scheme& scheme, std::ostream* out) {
  *out << to_string(scheme.kind);
}

class HeavyTopScheme : public ::testing::TestWithParam<Scheme> {};

TEST_P(HeavyTopScheme, ConvergesToTheClosedFormAtItsOrder) {
  constexpr double kSpin = 60.0;
  const testing::HeavyTop top = closed_form(kSpin);
  std::vector<double> times;
  for (int i = 1; i <= 20; ++i)
    times.push_back(0.1 * i * top.nutation_period());
  double errors[2] = {0.0, 0.0};
  for (int i = 0; i < 2; ++i) {
    const auto states =
        run(kSpin, GetParam().kind, GetParam().step / (1 << i), times);
    for (std::size_t k = 0; k < times.size(); ++k) {
      errors[i] = std::max(
          errors[i], std::abs(find_axis(states[k])[2] - top.cosine(times[k])));
    }
  }
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), GetParam().order, 0.1);
}

INSTANTIATE_TEST_SUITE_P(
    AllSchemes, HeavyTopScheme,
    ::testing::Values(Scheme{IntegratorKind::generalized_alpha, 2.0, 5e-4},
                      Scheme{IntegratorKind::runge_kutta_4, 4.0, 5e-4},
                      Scheme{IntegratorKind::explicit_euler, 1.0, 2e-5},
                      Scheme{IntegratorKind::energy_conserving, 2.0, 5e-4},
                      Scheme{IntegratorKind::splitting, 2.0, 5e-5}));

}  // namespace
}  // namespace limber::dynamics::heavy_top_test
