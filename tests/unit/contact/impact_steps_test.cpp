// SPDX-License-Identifier: BSD-3-Clause
// Impacts in steps that do not resolve them.
#include "limber/dynamics/monitors/impact_steps.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <memory>

#include "limber/contact/patches/patch_pair.hpp"
#include "limber/dynamics/simulation/run_record.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/simulation/simulator.hpp"
#include "unit/contact/ball_on_floor.hpp"

namespace limber::contact::impact_steps_test {
namespace {

using dynamics::IntegratorKind;
using test::BallOnFloor;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double kSpeed = 0.5;  // [m/s]

/// T_c = 3.218 (m^2 / (k^2 v))^(1/5) of a ball on a fixed plane [s].
double find_duration() {
  const double k = test::hertz_stiffness();
  return 3.2180 *
         std::pow(test::kBallMass * test::kBallMass / (k * k * kSpeed), 0.2);
}

struct Outcome {
  double restitution = 0.0;
  dynamics::SimulationStatistics statistics;
  double drift = 0.0;
};

Outcome bounce(double restitution, double step, double impact_steps,
               IntegratorKind kind = IntegratorKind::generalized_alpha) {
  BallOnFloor scene({.restitution = restitution}, {0.0, 0.0, -kSpeed});
  dynamics::SimulationSettings settings;
  settings.integrator = kind;
  settings.step = step;
  settings.end_time = std::max(100.0 * step, 20.0 * find_duration());
  settings.impact_steps = impact_steps;
  Outcome out;
  dynamics::RunRecord record;
  dynamics::simulate(scene.model, scene.state, settings, {}, {}, out.statistics,
                     {}, {}, record);
  out.restitution = scene.state.bodies[0].v_WB_W.z() / kSpeed;
  out.drift = record.energy.worst.drift.value;
  return out;
}

TEST(ImpactSteps, GiveTheRestitutionAskedForInAnyStep) {
  for (const double e : {1.0, 0.8, 0.5, 0.2}) {
    for (const double part : {0.01, 0.3, 1.0, 3.0, 30.0, 1000.0}) {
      const Outcome out = bounce(e, part * find_duration(), 20.0);
      EXPECT_NEAR(out.restitution, e, 0.01) << e << ' ' << part;
      EXPECT_THAT(out.statistics.warnings, IsEmpty()) << e << ' ' << part;
    }
  }
}

TEST(ImpactSteps, ServeExplicitAndOtherImplicitSchemes) {
  for (const IntegratorKind kind :
       {IntegratorKind::energy_conserving, IntegratorKind::runge_kutta_4,
        IntegratorKind::central_differences}) {
    const Outcome out = bounce(0.8, 10.0 * find_duration(), 24.0, kind);
    EXPECT_NEAR(out.restitution, 0.8, 0.01) << to_string(kind);
  }
}

// Second order in the parts' length, whatever the step.
TEST(ImpactSteps, ConvergeWithTheNumberOfParts) {
  const double step = 20.0 * find_duration();
  const double coarse = std::abs(bounce(0.8, step, 48.0).restitution - 0.8);
  const double fine = std::abs(bounce(0.8, step, 192.0).restitution - 0.8);
  EXPECT_LT(coarse, 5e-4);
  EXPECT_LT(fine, coarse / 12.0);  // 16 in the limit
}

// The outcome may change by what the parts leave, not with the run's step.
TEST(ImpactSteps, MakeTheOutcomeFreeOfTheStep) {
  const double first = bounce(0.8, 2.0 * find_duration(), 48.0).restitution;
  for (const double part : {7.0, 50.0, 400.0}) {
    EXPECT_NEAR(bounce(0.8, part * find_duration(), 48.0).restitution, first,
                2e-3)
        << part;
  }
}

/// Energy that a block gains or loses, without an account of it, while it turns
/// about an edge on the floor, without friction, and lands on a face; relative
/// to its kinetic energy before [-].
double topple(double restitution, double step) {
  const Vector3 half(0.05, 0.04, 0.03);
  constexpr double kMass = 10.0;
  constexpr double kTilt = 0.02;  // [rad]
  constexpr double kSpin = 2.0;   // [rad/s]
  const Vector3 q = half.cwiseProduct(half);
  const Vector3 moments(q.y() + q.z(), q.x() + q.z(), q.x() + q.y());
  const Matrix3 inertia = kMass / 3.0 * moments.asDiagonal();
  const SurfaceMaterial soft{1e10, 0.3};
  constexpr double kFixed = std::numeric_limits<double>::infinity();
  dynamics::SystemBuilder builder;
  const auto block = builder.add_rigid_body("block", {kMass, inertia});
  builder.add_pair("floor/block", dynamics::kWorld, block,
                   std::make_shared<PatchPair>(
                       ContactSide{Shape{HalfSpace{}, {}}, soft, kFixed},
                       ContactSide{Shape{Box{half}, {}}, soft, kMass, inertia},
                       ContactParameters{.restitution = restitution}));
  dynamics::SystemModel model = builder.build();
  model.gravity_W = {0.0, 0.0, -9.81};
  dynamics::SystemState state = dynamics::make_state(model);
  dynamics::BodyState& body = state.bodies[0];
  // The edge at +x is the lowest; it does not move up or down.
  body.quat_WB = Eigen::AngleAxisd(kTilt, Vector3::UnitY());
  body.p_WB.z() =
      half.x() * std::sin(kTilt) + half.z() * std::cos(kTilt) - 1e-7;
  body.w_WB_B = {0.0, -kSpin, 0.0};
  body.v_WB_W.z() =
      -kSpin * (half.x() * std::cos(kTilt) - half.z() * std::sin(kTilt));
  const double kinetic =
      0.5 * (kMass * body.v_WB_W.squaredNorm() + inertia(1, 1) * kSpin * kSpin);
  dynamics::SimulationStatistics statistics;
  dynamics::RunRecord record;
  dynamics::simulate(model, state, {.end_time = 0.02, .step = step}, {}, {},
                     statistics, {}, {}, record);
  EXPECT_FALSE(record.contacts.empty());
  return record.energy.worst.drift.value / kinetic;
}

// Implicit Euler alone would lose most of it, generalized-alpha some percent.
TEST(ImpactSteps, BalanceTheEnergyInAnyStep) {
  for (const IntegratorKind kind :
       {IntegratorKind::generalized_alpha, IntegratorKind::implicit_euler}) {
    for (const double e : {1.0, 0.8, 0.3}) {
      for (const double part : {0.01, 3.0, 300.0}) {
        const Outcome out = bounce(e, part * find_duration(), 20.0, kind);
        const double kinetic = 0.5 * test::kBallMass * kSpeed * kSpeed;
        EXPECT_LT(std::abs(out.drift), 1e-9 * kinetic) << e << ' ' << part;
        EXPECT_NEAR(out.restitution, e, 0.01) << e << ' ' << part;
      }
    }
  }
}

// A bounce of an elastic ball, whose energy the parts keep.
TEST(ImpactSteps, KeepTheSpeedOfAnElasticBall) {
  for (const double part : {0.3, 7.0, 100.0}) {
    const Outcome out = bounce(1.0, part * find_duration(), 20.0);
    EXPECT_NEAR(out.restitution, 1.0, 1e-10) << part;
  }
}

// Of a face that lands while its edge already touches: there is no event where
// the impact begins, and a step that does not resolve it would end it.
TEST(ImpactSteps, ResolveAFaceThatLandsOnItsEdge) {
  for (const double e : {1.0, 0.5, 0.0}) {
    for (const double step : {1e-3, 1e-4}) {
      EXPECT_LT(std::abs(topple(e, step)), 1e-4) << e << ' ' << step;
    }
  }
}

// Within the impact, whose steps are not those of the run's scheme, and after.
TEST(ImpactSteps, GoOnToTheBitFromACheckpointInAnImpact) {
  for (const IntegratorKind kind :
       {IntegratorKind::generalized_alpha, IntegratorKind::implicit_euler}) {
    for (const double part : {0.04, 0.3}) {
      const BallOnFloor scene(
          {.friction = {.sliding = 0.3}, .restitution = 0.8},
          {0.2, 0.0, -kSpeed});
      dynamics::SimulationSettings settings;
      settings.integrator = kind;
      settings.step = part * find_duration();
      settings.end_time = 3.0 * find_duration();
      dynamics::Simulator first(scene.model, scene.state, settings);
      first.advance_to(0.6 * find_duration());
      ASSERT_GT(first.calc_energy().coupler, 0.0);
      const dynamics::Checkpoint checkpoint = first.save();
      first.advance_to(settings.end_time);
      dynamics::Simulator second(scene.model, scene.state, settings);
      second.restore(checkpoint);
      second.advance_to(settings.end_time);
      EXPECT_EQ(first.state().bodies[0].p_WB, second.state().bodies[0].p_WB);
      EXPECT_EQ(first.state().bodies[0].v_WB_W,
                second.state().bodies[0].v_WB_W);
      EXPECT_EQ(first.state().bodies[0].w_WB_B,
                second.state().bodies[0].w_WB_B);
    }
  }
}

/// A ball that lies on the floor for a second, in steps of 1.5 T_c.
dynamics::SimulationStatistics rest(double impact_steps) {
  BallOnFloor scene({.restitution = 0.5}, Vector3::Zero());
  scene.model.gravity_W = {0.0, 0.0, -9.81};
  const double sunk =
      std::pow(test::kBallMass * 9.81 / test::hertz_stiffness(), 2.0 / 3.0);
  scene.state.bodies[0].p_WB.z() = test::kBallRadius - sunk;
  dynamics::SimulationSettings settings;
  settings.step = 1e-3;
  settings.end_time = 1.0;
  settings.impact_steps = impact_steps;
  dynamics::SimulationStatistics statistics;
  dynamics::simulate(scene.model, scene.state, settings, {}, {}, statistics);
  EXPECT_NEAR(scene.state.bodies[0].p_WB.z(), test::kBallRadius - sunk, 1e-9);
  EXPECT_THAT(statistics.warnings, IsEmpty());
  return statistics;
}

// It is not struck.
TEST(ImpactSteps, LeaveRestToTheStepsOfTheRun) {
  EXPECT_LT(rest(20.0).linear_solves, 1.1 * rest(1.0).linear_solves);
}

// 2000 parts would be needed: the rest after 1000 is one step, which is told.
TEST(ImpactSteps, AreBoundedWithAWarning) {
  const Outcome out = bounce(1.0, 5.0 * find_duration(), 1000.0);
  EXPECT_THAT(
      out.statistics.warnings,
      ::testing::Contains(HasSubstr("a step was divided into 1000 parts")));
}

// Its steps are bounded by most_steps.
TEST(ImpactSteps, HaveNoBoundWithATolerance) {
  BallOnFloor scene({.restitution = 1.0}, {0.0, 0.0, -kSpeed});
  dynamics::SimulationSettings settings;
  settings.step = find_duration();
  settings.tolerance = 1e-4;
  settings.end_time = 20.0 * find_duration();
  settings.impact_steps = 2000.0;
  dynamics::SimulationStatistics statistics;
  dynamics::simulate(scene.model, scene.state, settings, {}, {}, statistics);
  EXPECT_GT(statistics.steps, 1000);
  EXPECT_THAT(statistics.warnings, IsEmpty());
  EXPECT_NEAR(scene.state.bodies[0].v_WB_W.z(), kSpeed, 1e-4 * kSpeed);
}

}  // namespace
}  // namespace limber::contact::impact_steps_test
