// SPDX-License-Identifier: BSD-3-Clause
// Closed forms of generalized-alpha under loads that grow linearly.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "limber/dynamics/equations/motion_scale.hpp"
#include "limber/dynamics/integrators/generalized_alpha.hpp"
#include "limber/dynamics/system/system_builder.hpp"

namespace limber::dynamics::linear_load_test {
namespace {

constexpr double kMass = 2.0;     // [kg]
constexpr double kInertia = 0.7;  // about z [kg m^2]
constexpr double kForce = 30.0;   // along x, per second [N/s]
constexpr double kMoment = 4.0;   // about z, per second [N m/s]

/// A rigid body under a force along x and a moment about z, both c t.
struct LinearlyLoadedBody {
  SystemModel model;
  SystemState state;

  explicit LinearlyLoadedBody(double force = kForce, double moment = kMoment) {
    SystemBuilder builder;
    const BodyIndex body = builder.add_rigid_body(
        "body", {kMass, Vector3(0.5, 0.6, kInertia).asDiagonal()});
    const AttachmentIndex centre = builder.attach_frame("centre", body, {});
    builder.add_load("load", centre, {force, 0.0, 0.0}, {0.0, 0.0, moment},
                     LoadFrame::world,
                     Table{.times = {0.0, 100.0}, .values = {0.0, 100.0}});
    model = builder.build();
    state = make_state(model);
  }
};

double find_velocity(double t) { return 0.5 * kForce / kMass * t * t; }
double find_rate(double t) { return 0.5 * kMoment / kInertia * t * t; }

class AlphaUnderLinearLoads : public ::testing::TestWithParam<double> {};

// The averaged accelerations are those of another instant, whose distance
// changes with the step. Velocities are exact, except for what the start
// leaves.
TEST_P(AlphaUnderLinearLoads, KeepsVelocitiesExactWhenStepsChange) {
  LinearlyLoadedBody body;
  GeneralizedAlpha scheme(body.model,
                          {.rho_inf = GetParam(), .tolerance = 1e-14});
  SystemState& state = body.state;
  scheme.start(state, 0.01);
  const auto advance = [&](double h) {
    scheme.step(state, h, state.t + h);
    return state.bodies[0];
  };
  for (int i = 0; i < 100; ++i) advance(0.01);
  const double v_offset = state.bodies[0].v_WB_W.x() - find_velocity(state.t);
  const double w_offset = state.bodies[0].w_WB_B.z() - find_rate(state.t);
  for (const double h : {0.02, 0.005, 0.005, 0.0125, 0.03, 0.01, 0.0025}) {
    const BodyState now = advance(h);
    EXPECT_NEAR(now.v_WB_W.x() - find_velocity(state.t), v_offset, 1e-12) << h;
    EXPECT_NEAR(now.w_WB_B.z() - find_rate(state.t), w_offset, 1e-12) << h;
  }
}

// With velocities exact, what a step adds to the position is wrong by its own
// error.
TEST_P(AlphaUnderLinearLoads, TellsTheErrorOfAStepOfTranslation) {
  LinearlyLoadedBody body(kForce, 0.0);
  GeneralizedAlpha scheme(
      body.model,
      {.rho_inf = GetParam(), .tolerance = 1e-14, .estimates_error = true});
  SystemState& state = body.state;
  const double h = 0.01;
  scheme.start(state, h);
  for (int i = 0; i < 100; ++i) scheme.step(state, h, state.t + h);
  const double t = state.t;
  const double p = state.bodies[0].p_WB.x();
  const double v = state.bodies[0].v_WB_W.x();
  const StepResult result = scheme.step(state, h, t + h);
  const double exact =
      v * h + kForce / kMass * (t * h * h / 2.0 + h * h * h / 6.0);
  const double error = state.bodies[0].p_WB.x() - p - exact;
  EXPECT_GT(std::abs(error), 1e-8);
  EXPECT_NEAR(result.error, std::abs(error), 1e-3 * std::abs(error));
}

// A body that turns about an axis: its farthest point is as far as its radius
// of gyration, since no other is known.
TEST_P(AlphaUnderLinearLoads, TellsTheErrorOfAStepOfRotation) {
  LinearlyLoadedBody body(0.0, kMoment);
  GeneralizedAlpha scheme(
      body.model,
      {.rho_inf = GetParam(), .tolerance = 1e-14, .estimates_error = true});
  SystemState& state = body.state;
  const double h = 0.01;
  const auto angle = [&] {
    return 2.0 *
           std::atan2(state.bodies[0].quat_WB.z(), state.bodies[0].quat_WB.w());
  };
  scheme.start(state, h);
  for (int i = 0; i < 100; ++i) scheme.step(state, h, state.t + h);
  const double t = state.t;
  const double before = angle();
  const double w = state.bodies[0].w_WB_B.z();
  const StepResult result = scheme.step(state, h, t + h);
  const double exact =
      w * h + kMoment / kInertia * (t * h * h / 2.0 + h * h * h / 6.0);
  const double error =
      std::remainder(angle() - before, 2.0 * std::numbers::pi) - exact;
  const double reach = find_reach(body.model, BodyIndex(0));
  EXPECT_NEAR(result.error, reach * std::abs(error),
              1e-3 * reach * std::abs(error));
}

INSTANTIATE_TEST_SUITE_P(SpectralRadii, AlphaUnderLinearLoads,
                         ::testing::Values(0.3, 0.6, 0.9));

}  // namespace
}  // namespace limber::dynamics::linear_load_test
