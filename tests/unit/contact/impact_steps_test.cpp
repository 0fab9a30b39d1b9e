// SPDX-License-Identifier: BSD-3-Clause
// Impacts in steps that do not resolve them.
#include "limber/dynamics/monitors/impact_steps.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "limber/dynamics/simulation/run_record.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
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
  const double coarse = std::abs(bounce(0.8, step, 20.0).restitution - 0.8);
  const double fine = std::abs(bounce(0.8, step, 96.0).restitution - 0.8);
  EXPECT_LT(fine, 5e-4);
  EXPECT_LT(fine, coarse / 16.0);
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
  EXPECT_THAT(out.statistics.warnings,
              ::testing::Contains(HasSubstr("a step got 1000 parts")));
}

}  // namespace
}  // namespace limber::contact::impact_steps_test
