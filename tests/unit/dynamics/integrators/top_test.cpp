// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "limber/dynamics/integrators/runge_kutta.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "support/free_top.hpp"
#include "support/top_drift.hpp"

/// Free rigid bodies: closed forms, conservation, orthonormality.
namespace limber::dynamics::top_test {
namespace {

constexpr double kPublished = 5e-9;  // the references have nine digits

SystemModel make_body(const Vector3& inertia) {
  SystemBuilder builder;
  builder.add_rigid_body("top", {1.0, Matrix3(inertia.asDiagonal())});
  return builder.build();
}

SystemState make_spinning(const SystemModel& model, const Vector3& w) {
  SystemState state = make_state(model);
  state.bodies[0].w_WB_B = w;
  return state;
}

SimulationSettings with(IntegratorKind kind, double end, double step) {
  SimulationSettings settings;
  settings.integrator = kind;
  settings.end_time = end;
  settings.step = step;
  settings.rho_inf = 1.0;
  settings.newton_tolerance = 1e-14;  // the flip magnifies what is left
  return settings;
}

Vector3 spin_at(double t, IntegratorKind kind, double step) {
  const SystemModel model = make_body({1, 2, 3});
  SystemState state = make_spinning(model, {0.01, 1, 0});
  simulate(model, state, with(kind, t, step), {});
  return state.bodies[0].w_WB_B;
}

TEST(FreeTopClosedForm, HasThePublishedFiguresOfTheIntermediateAxisFlip) {
  const testing::FreeTop top(0.01);
  EXPECT_LT((top.angular_velocity(0) - Vector3(0.01, 1, 0)).norm(), 1e-12);
  EXPECT_LT((top.angular_velocity(20) -
             Vector3(0.010964161, -0.999989894, -0.002595690))
                .norm(),
            kPublished);
  EXPECT_LT((top.angular_velocity(30) -
             Vector3(0.818878322, -0.574054260, 0.472744366))
                .norm(),
            kPublished);
  EXPECT_NEAR(top.flip_time(), 20.754610, 1e-6);
}

TEST(RungeKutta4, TopMeetsThePublishedFigures) {
  const auto spin = [](double t) {
    return spin_at(t, IntegratorKind::runge_kutta_4, 0.002);
  };
  EXPECT_LT(
      (spin(20) - Vector3(0.010964161, -0.999989894, -0.002595690)).norm(),
      kPublished);
  EXPECT_LT((spin(30) - Vector3(0.818878322, -0.574054260, 0.472744366)).norm(),
            kPublished);
  for (const double zero : {10.377305, 31.131915, 51.886524}) {
    EXPECT_NEAR(spin(zero)[1], 0.0, 1e-6) << zero;  // the times' last digit
  }
}

// Each flip magnifies what went before, round-off too: a sum that drops it is
// wrong by more than this after a hundred. Three seconds about the flip are the
// worst.
TEST(RungeKutta4, TopMeetsTheClosedFormTo1e9AfterAHundredFlips) {
  const testing::FreeTop top(0.01);
  const SystemModel model = make_body({1, 2, 3});
  SystemState state = make_spinning(model, {0.01, 1, 0});
  const double middle = 99.5 * top.flip_time();
  SimulationSettings settings =
      with(IntegratorKind::runge_kutta_4, middle + 3.0, 0.0025);
  for (int i = -3; i <= 3; ++i) settings.output_times.push_back(middle + i);
  int compared = 0;
  simulate(model, state, settings,
           [&](const SystemState& now, const EnergyBalance&) {
             EXPECT_LT(
                 (now.bodies[0].w_WB_B - top.angular_velocity(now.t)).norm(),
                 1e-9)
                 << now.t;
             ++compared;
           });
  EXPECT_EQ(compared, 7);
}

// Moving the body restarts the compensated sum; otherwise it continues.
TEST(RungeKutta4, CarriesRoundOffOnlyForTheStateThatItLeft) {
  const SystemModel model = make_body({1, 2, 3});
  RungeKutta4 used(model);
  SystemState state = make_spinning(model, {0.01, 1, 0});
  for (int i = 1; i <= 100; ++i) used.step(state, 0.01, 0.01 * i);
  SystemState moved = make_spinning(model, {0.3, 0.4, 0.5});
  SystemState fresh = moved;
  used.step(moved, 0.01, 0.01);
  RungeKutta4(model).step(fresh, 0.01, 0.01);
  EXPECT_EQ(moved.bodies[0].w_WB_B, fresh.bodies[0].w_WB_B);
  EXPECT_EQ(moved.bodies[0].quat_WB.coeffs(), fresh.bodies[0].quat_WB.coeffs());
}

struct Scheme {
  IntegratorKind kind;
  double order;
  double step;  ///< [s]
};

void PrintTo(const Scheme& scheme, std::ostream* out) {
  *out << to_string(scheme.kind);
}

class TopScheme : public ::testing::TestWithParam<Scheme> {};

// Through the flip: Omega_2 turns from 1 to -1 between 0 and 20 s.
TEST_P(TopScheme, ConvergesToTheClosedFormAtItsOrder) {
  const testing::FreeTop top(0.01);
  for (const double t : {20.0, 30.0}) {
    double errors[2];
    for (int i = 0; i < 2; ++i) {
      const double step = GetParam().step / (1 << i);
      errors[i] =
          (spin_at(t, GetParam().kind, step) - top.angular_velocity(t)).norm();
    }
    EXPECT_NEAR(std::log2(errors[0] / errors[1]), GetParam().order, 0.1) << t;
  }
}

// The flip magnifies errors; Euler's needs the shortest steps.
INSTANTIATE_TEST_SUITE_P(
    AllSchemes, TopScheme,
    ::testing::Values(Scheme{IntegratorKind::generalized_alpha, 2.0, 0.01},
                      Scheme{IntegratorKind::runge_kutta_4, 4.0, 0.02},
                      Scheme{IntegratorKind::explicit_euler, 1.0, 2e-5},
                      Scheme{IntegratorKind::energy_conserving, 2.0, 0.01},
                      Scheme{IntegratorKind::splitting, 2.0, 0.01}));

// --- Extreme inertias and rates ----------------------------------------------

using testing::Drift;

/// Largest drifts over 2000 steps, each a turn by `angle`.
Drift find_drift(const Vector3& inertia, IntegratorKind kind, double rate,
                 double angle) {
  const SystemModel model = make_body(inertia);
  const SystemState state =
      make_spinning(model, rate * Vector3(0.6, 0.64, 0.48).normalized());
  return testing::find_drift(
      model, state, with(kind, 2000.0 * angle / rate, angle / rate), 100);
}

constexpr double kSteps = 2000.0;
constexpr double kRoundOff = 2.2e-16 * kSteps;

struct Body {
  const char* name;
  Vector3 inertia;
};

void PrintTo(const Body& body, std::ostream* out) { *out << body.name; }

class ExtremeBody : public ::testing::TestWithParam<std::tuple<Body, Scheme>> {
};

// A step's error is (turn)^(order + 1); halved steps over half the time leave
// half of that share, or round-off.
TEST_P(ExtremeBody, ConservesToItsOrderAtEveryRate) {
  const auto& [body, scheme] = GetParam();
  for (const double rate : {1e-6, 1.0, 1e4}) {
    const Drift coarse = find_drift(body.inertia, scheme.kind, rate, 0.02);
    const Drift fine = find_drift(body.inertia, scheme.kind, rate, 0.01);
    const double shrink = std::pow(2.0, -scheme.order + 0.3);
    EXPECT_LE(fine.energy, shrink * coarse.energy + kRoundOff) << rate;
    EXPECT_LE(fine.momentum, shrink * coarse.momentum + kRoundOff) << rate;
    EXPECT_LE(coarse.orthonormality, 1e-14) << rate;
    // Nothing but time scales with the rate.
    const Drift unit = find_drift(body.inertia, scheme.kind, 1.0, 0.02);
    EXPECT_NEAR(coarse.energy, unit.energy, 1e-6 * unit.energy + kRoundOff);
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, ExtremeBody,
    ::testing::Combine(
        ::testing::Values(Body{"near-spherical", {1.0, 1.0 + 1e-6, 1.0 - 1e-6}},
                          Body{"needle", {1e-6, 1.0, 1.0}},
                          Body{"disc", {0.5 + 5e-7, 0.5, 1.0}},
                          Body{"asymmetric", {1.0, 2.0, 3.0}}),
        ::testing::Values(Scheme{IntegratorKind::generalized_alpha, 2.0, 0.0},
                          Scheme{IntegratorKind::runge_kutta_4, 4.0, 0.0},
                          Scheme{IntegratorKind::explicit_euler, 1.0, 0.0},
                          Scheme{IntegratorKind::energy_conserving, 2.0, 0.0},
                          Scheme{IntegratorKind::splitting, 2.0, 0.0})),
    [](const auto& test) {
      std::string name = std::get<0>(test.param).name;
      std::erase(name, '-');
      return name +
             std::to_string(static_cast<int>(std::get<1>(test.param).kind));
    });

// Both are quadratic invariants of the scheme; the rest is round-off, which
// does not accumulate.
TEST(EnergyConserving, KeepsATopsEnergyAndMomentumToRoundOffAtAnyTurn) {
  for (const double angle : {1e-4, 0.02, 0.5}) {
    const Drift drift =
        find_drift({1, 2, 3}, IntegratorKind::energy_conserving, 10.0, angle);
    EXPECT_LT(drift.energy, kRoundOff) << angle;
    EXPECT_LT(drift.momentum, kRoundOff) << angle;
    EXPECT_LT(drift.orthonormality, 1e-14) << angle;
  }
}

}  // namespace
}  // namespace limber::dynamics::top_test
