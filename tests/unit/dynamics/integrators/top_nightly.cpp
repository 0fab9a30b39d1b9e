// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "support/top_drift.hpp"

/// Free tops over ten million steps.
namespace limber::dynamics::top_nightly {
namespace {

using testing::Drift;

constexpr double kSteps = 1e7;
constexpr double kTurn = 0.01;  // a step [rad]

Drift find_drift(const Vector3& inertia, IntegratorKind kind, double rate) {
  SystemBuilder builder;
  builder.add_rigid_body("top", {1.0, Matrix3(inertia.asDiagonal())});
  const SystemModel model = builder.build();
  SystemState state = make_state(model);
  state.bodies[0].w_WB_B = rate * Vector3(0.6, 0.64, 0.48).normalized();
  SimulationSettings settings;
  settings.integrator = kind;
  settings.step = kTurn / rate;
  settings.end_time = kSteps * settings.step;
  settings.rho_inf = 1.0;
  return testing::find_drift(model, state, settings, 1000);
}

// For a motion at rate w the energy factor of Runge-Kutta is |R(i w h)|^2 = 1 -
// (w h)^6 / 72 a step; w in the body is at most the spin for these inertias.
// The error of the momentum's direction is the local error, (w h)^5 / 120 a
// step. Compensated summation prevents accumulation of round-off.
TEST(TenMillionSteps, OfRungeKuttaLoseWhatItsOrderSaysAndNoMore) {
  struct Top {
    Vector3 inertia;
    double rate;
  };
  for (const Top& top : std::vector<Top>{{{1, 2, 3}, 1e4},
                                         {{1e-6, 1, 1}, 1e-6},
                                         {{1, 1 + 1e-6, 1 - 1e-6}, 1.0}}) {
    const Drift drift =
        find_drift(top.inertia, IntegratorKind::runge_kutta_4, top.rate);
    EXPECT_LT(drift.energy, kSteps * std::pow(kTurn, 6) / 72.0);
    EXPECT_LT(drift.momentum, kSteps * std::pow(kTurn, 5) / 120.0);
    EXPECT_LT(drift.orthonormality, 1e-14);
  }
}

// Without damping the scheme's errors swing by the square of the turn.
TEST(TenMillionSteps, OfGeneralizedAlphaStayWithinTheSquareOfAStep) {
  const Drift drift =
      find_drift({1, 2, 3}, IntegratorKind::generalized_alpha, 1.0);
  EXPECT_LT(drift.energy, kTurn * kTurn);
  EXPECT_LT(drift.momentum, kTurn * kTurn);
  EXPECT_LT(drift.orthonormality, 1e-14);
}

}  // namespace
}  // namespace limber::dynamics::top_nightly
