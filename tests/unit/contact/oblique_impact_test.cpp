// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "limber/dynamics/simulation/run_record.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "unit/contact/ball_on_floor.hpp"
#include "unit/contact/rings.hpp"

/// A ball that strikes the floor obliquely, against the textbook of rigid
/// spheres: with v_t > 7/2 mu (1 + e) v_n it slides throughout.
namespace limber::contact::oblique_impact_test {
namespace {

using test::BallOnFloor;
using test::kBallRadius;

struct Rebound {
  double v_t = 0.0;     ///< [m/s]
  double v_n = 0.0;     ///< [m/s]
  double w_rim = 0.0;   ///< of the rim, by the spin [m/s]
  double energy = 0.0;  ///< kinetic, over the mass [J/kg]
};

Rebound strike(double friction, double restitution, double v_t) {
  BallOnFloor scene(
      {.friction = {.sliding = friction}, .restitution = restitution},
      {v_t, 0.0, -1.0});
  dynamics::SimulationSettings settings;
  settings.end_time = 2e-4;
  settings.step = 2e-7;
  dynamics::simulate(scene.model, scene.state, settings, {});
  const dynamics::BodyState& ball = scene.state.bodies[0];
  const Vector3 w_W = ball.quat_WB * ball.w_WB_B;
  return {ball.v_WB_W.x(), ball.v_WB_W.z(), w_W.y() * kBallRadius,
          0.5 * ball.v_WB_W.squaredNorm() +
              0.2 * kBallRadius * kBallRadius * w_W.squaredNorm()};
}

double find_limit(double friction, double restitution) {
  return 3.5 * friction * (1.0 + restitution);
}

// v_t = v_t0 - mu (1 + e) v_n, and 2/5 R w = mu (1 + e) v_n except for the
// depth, by which the floor is nearer to the centre.
TEST(ObliqueImpact, SlidesThroughoutAtFlatAngles) {
  for (const double restitution : {1.0, 0.7, 0.3}) {
    for (const double friction : {0.1, 0.3}) {
      for (const double fraction : {1.05, 1.5, 3.0}) {
        const double v_t = fraction * find_limit(friction, restitution);
        const double taken = friction * (1.0 + restitution);
        const Rebound after = strike(friction, restitution, v_t);
        EXPECT_NEAR(after.v_n, restitution, 1e-3);
        EXPECT_NEAR(after.v_t, v_t - taken, 1e-3 * taken);
        EXPECT_NEAR(after.w_rim, 2.5 * taken, 2e-3 * 2.5 * taken);
      }
    }
  }
}

// At the limit it leaves rolling, with 5/7 v_t0.
TEST(ObliqueImpact, LeavesRollingAtTheLimit) {
  for (const double restitution : {1.0, 0.7, 0.3}) {
    const double v_t = find_limit(0.3, restitution);
    const Rebound after = strike(0.3, restitution, v_t);
    EXPECT_NEAR(after.v_t / v_t, 5.0 / 7.0, 2e-3);
    EXPECT_NEAR(after.w_rim / v_t, 5.0 / 7.0, 2e-3);
  }
}

// Steeper it sticks for a while; what it touches with then swings back, as of
// elastic spheres [Maw, Barber and Fawcett 1976], and not faster than it came.
// Moments about the place of the impact are zero: v_t + 2/5 R w stays.
TEST(ObliqueImpact, SticksAtSteepAngles) {
  for (const double restitution : {1.0, 0.7, 0.3}) {
    for (const double fraction : {0.05, 0.2, 0.4, 0.6, 0.8, 0.95}) {
      const double v_t = fraction * find_limit(0.3, restitution);
      const Rebound after = strike(0.3, restitution, v_t);
      EXPECT_NEAR((after.v_t + 0.4 * after.w_rim) / v_t, 1.0, 2e-3);
      EXPECT_LT(std::abs(after.v_t - after.w_rim), v_t);
      EXPECT_LE(after.energy, 0.5 * (1.0 + v_t * v_t) * (1.0 + 1e-4));
    }
  }
}

// The velocity of the place of contact after an elastic impact, by leapfrog.
double strike_rings(double friction, double v_t) {
  const double k = test::hertz_stiffness();
  const double modulus = 0.75 * k / std::sqrt(kBallRadius);
  const double most = std::pow(1.25 * test::kBallMass / k, 0.4);
  test::Rings rings({kBallRadius, modulus, 1.4 / 1.7, friction}, most);
  const double h = 2.94 * most / 3000.0;
  const auto press = [&](double d) {
    return k * std::pow(std::max(d, 0.0), 1.5) / test::kBallMass;
  };
  double d = 0.0;
  double w = 1.0;
  double v = v_t;
  double T = 0.0;
  do {
    w -= 0.5 * h * press(d);
    v -= 0.5 * h * 3.5 * T;
    d += h * w;
    T = d > 0.0 ? rings.move(d, h * v, 1.0) / test::kBallMass : 0.0;
    w -= 0.5 * h * press(d);
    v -= 0.5 * h * 3.5 * T;
  } while (d > 0.0);
  return v;
}

// Within 0.05 of mu v_n / kappa.
TEST(ObliqueImpact, TurnsThePlaceOfContactAsTheExactSolution) {
  const double kappa = 1.4 / 1.7;
  for (const double friction : {0.1, 0.3}) {
    for (const double psi : {0.2, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 8.0}) {
      const double v_t = psi * friction / kappa;
      const Rebound after = strike(friction, 1.0, v_t);
      EXPECT_NEAR((after.v_t - after.w_rim) * kappa / friction,
                  strike_rings(friction, v_t) * kappa / friction, 0.05)
          << psi;
    }
  }
}

// The mirror image.
TEST(ObliqueImpact, IsTheSameFromTheOtherSide) {
  const Rebound there = strike(0.3, 0.7, 1.2);
  const Rebound back = strike(0.3, 0.7, -1.2);
  EXPECT_NEAR(there.v_t, -back.v_t, 1e-9);
  EXPECT_NEAR(there.w_rim, -back.w_rim, 1e-9);
}

}  // namespace
}  // namespace limber::contact::oblique_impact_test
