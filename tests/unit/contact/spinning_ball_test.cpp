// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "limber/contact/make_contact.hpp"
#include "limber/dynamics/simulation/run_record.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "unit/contact/ball_on_floor.hpp"

/// A ball that spins upright on the floor, against the closed form of full slip
/// under Hertz's pressure: M = 3 pi mu f a / 16 [@johnson1985, ch. 7].
namespace limber::contact::spinning_ball_test {
namespace {

using test::kBallMass;
using test::kBallRadius;

constexpr double kPi = std::numbers::pi;
constexpr double kGravity = 10.0;  // [m/s^2]
constexpr double kFriction = 0.3;
constexpr double kInertia = 0.4 * kBallMass * kBallRadius * kBallRadius;
constexpr double kLoad = kBallMass * kGravity;

/// Radius of Hertz's area [m].
double find_area_radius() {
  constexpr double kModulus = 2.1e11 / (2.0 * (1.0 - 0.09));
  return std::cbrt(0.75 * kLoad * kBallRadius / kModulus);
}

/// Rate at which the spin falls [rad/s^2].
double find_rate() {
  return 3.0 * kPi / 16.0 * kFriction * kLoad * find_area_radius() / kInertia;
}

/// 16 a^3 G_r / 3, 1/G_r = 2 / G, of an area that sticks [N m/rad].
double find_stiffness() {
  return 16.0 / 3.0 * std::pow(find_area_radius(), 3) * 0.5 * 2.1e11 / 2.6;
}

/// The ball rests on the floor under gravity, and a moment about the vertical
/// acts on it.
struct RestingBall {
  dynamics::SystemModel model;
  dynamics::SystemState state;

  RestingBall(double friction, double rate, double moment) {
    dynamics::SystemBuilder builder;
    builder.set_gravity({0.0, 0.0, -kGravity});
    const auto ball = builder.add_rigid_body(
        "ball", {kBallMass, kInertia * Matrix3::Identity()});
    constexpr double kFixed = std::numeric_limits<double>::infinity();
    builder.add_pair(
        "floor/ball", dynamics::kWorld, ball,
        make_contact(ContactSide{Shape{HalfSpace{}, {}}, test::kSteel, kFixed},
                     ContactSide{Shape{Sphere{kBallRadius}, {}}, test::kSteel,
                                 kBallMass},
                     ContactParameters{.friction = {.sliding = friction}}));
    builder.add_load("moment", builder.attach_frame("middle", ball, {}),
                     Vector3::Zero(), {0.0, 0.0, moment},
                     dynamics::LoadFrame::body, dynamics::Constant{});
    model = builder.build();
    state = dynamics::make_state(model);
    const double depth = std::pow(kLoad / test::hertz_stiffness(), 2.0 / 3.0);
    state.bodies[0].p_WB.z() = kBallRadius - depth;
    state.bodies[0].w_WB_B = {0.0, 0.0, rate};
  }
};

struct Spin {
  double rate = 0.0;   ///< at the end [rad/s]
  double drift = 0.0;  ///< of the energy, over that of the spin [-]
};

Spin spin(double friction, double start, double end,
          dynamics::IntegratorKind scheme, double moment = 0.0) {
  RestingBall scene(friction, start, moment);
  dynamics::SimulationSettings settings;
  settings.integrator = scheme;
  settings.end_time = end;
  settings.step = 5e-5;
  dynamics::RunRecord record;
  dynamics::SimulationStatistics statistics;
  dynamics::simulate(scene.model, scene.state, settings, {}, {}, statistics, {},
                     {}, record);
  const dynamics::BodyState& ball = scene.state.bodies[0];
  EXPECT_LT(ball.v_WB_W.norm(), 1e-6);
  return {ball.w_WB_B.z(),
          record.energy.drift.value / (0.5 * kInertia * start * start)};
}

// So fast that the turn until all of the area slips, 1.5 limit / k_r, takes
// 0.1 % of the time.
TEST(SpinningBall, SlowsDownAsFullSlipSays) {
  constexpr double kStart = 0.5;
  const double lasts = kStart / find_rate();
  for (const auto scheme : {dynamics::IntegratorKind::generalized_alpha,
                            dynamics::IntegratorKind::energy_conserving}) {
    const Spin half = spin(kFriction, kStart, 0.5 * lasts, scheme);
    EXPECT_NEAR(half.rate, 0.5 * kStart, 0.005 * kStart);
    EXPECT_NEAR(half.drift, 0.0, 0.01);
    const Spin stopped = spin(kFriction, kStart, 4.0 * lasts, scheme);
    // What springs at their limit can keep swings out.
    const double limit = find_rate() * kInertia;
    EXPECT_LT(std::abs(stopped.rate),
              limit / std::sqrt(kInertia * find_stiffness()));
  }
}

TEST(SpinningBall, TurnsTheOtherWayAlike) {
  const Spin there =
      spin(kFriction, 0.05, 0.01, dynamics::IntegratorKind::generalized_alpha);
  const Spin back =
      spin(kFriction, -0.05, 0.01, dynamics::IntegratorKind::generalized_alpha);
  EXPECT_NEAR(there.rate, -back.rate, 1e-9);
}

TEST(SpinningBall, SpinsOnWithoutFriction) {
  EXPECT_NEAR(
      spin(0.0, 0.05, 0.02, dynamics::IntegratorKind::generalized_alpha).rate,
      0.05, 1e-12);
}

// By the angle that it turns by.
TEST(SpinningBall, RestsOnTheTorsionalStiffnessOfItsArea) {
  const double stiffness = find_stiffness();
  const double moment = 1e-3 * find_rate() * kInertia;
  RestingBall scene(kFriction, 0.0, moment);
  dynamics::SimulationSettings settings;
  const double period = 2.0 * kPi * std::sqrt(kInertia / stiffness);
  settings.end_time = 0.5 * period;
  settings.step = period / 2000.0;
  dynamics::simulate(scene.model, scene.state, settings, {});
  // Half a swing about the angle at rest, from 0.
  const dynamics::BodyState& ball = scene.state.bodies[0];
  const double angle = 2.0 * std::atan2(ball.quat_WB.z(), ball.quat_WB.w());
  EXPECT_NEAR(angle * stiffness / (2.0 * moment), 1.0, 0.02);
  EXPECT_NEAR(ball.w_WB_B.z() * std::sqrt(kInertia * stiffness) / moment, 0.0,
              0.04);
}

// The limit is a moment that friction can hold.
TEST(SpinningBall, HoldsAgainstALesserMoment) {
  const auto scheme = dynamics::IntegratorKind::generalized_alpha;
  const double limit = find_rate() * kInertia;
  EXPECT_NEAR(spin(kFriction, 0.0, 0.4, scheme, 0.9 * limit).rate, 0.0,
              0.005 * find_rate() * 0.4);
  // Once all of the area slips.
  const double first = spin(kFriction, 0.0, 0.1, scheme, 1.5 * limit).rate;
  const double last = spin(kFriction, 0.0, 0.2, scheme, 1.5 * limit).rate;
  EXPECT_NEAR((last - first) / 0.1, 0.5 * find_rate(), 0.002 * find_rate());
}

}  // namespace
}  // namespace limber::contact::spinning_ball_test
