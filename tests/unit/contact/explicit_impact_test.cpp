// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <cmath>
#include <string>

#include "limber/dynamics/simulation/run_record.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "unit/contact/ball_on_floor.hpp"

/// Explicit schemes and the stiffness of a contact, against Hertz's.
namespace limber::contact::explicit_impact_test {
namespace {

using dynamics::IntegratorKind;
using test::BallOnFloor;
using test::kBallMass;
using ::testing::HasSubstr;

std::vector<std::string> find_warnings(IntegratorKind scheme, double step,
                                       double speed = 1.0) {
  BallOnFloor scene({}, {0.0, 0.0, -speed});
  scene.state.bodies[0].p_WB.z() = test::kBallRadius + 1e-6 * speed;
  dynamics::SimulationSettings settings;
  settings.end_time = 1e-4 * std::pow(speed, -0.2);
  settings.step = step;
  settings.integrator = scheme;
  dynamics::SimulationStatistics statistics;
  dynamics::RunRecord record;
  dynamics::simulate(scene.model, scene.state, settings, {}, {}, statistics, {},
                     {}, record);
  return statistics.warnings;
}

/// The step that a warning names, 0 if none does [s].
double find_named_step(const std::vector<std::string>& warnings) {
  const std::string words = "is stable up to ";
  for (const std::string& text : warnings) {
    const std::size_t at = text.find(words);
    if (at != std::string::npos)
      return std::stod(text.substr(at + words.size()));
  }
  return 0.0;
}

// d_p = (5 m v^2 / (4 k))^(2/5), omega^2 = 3/2 k sqrt(d_p) / m.
double find_omega(double speed = 1.0) {
  const double k = test::hertz_stiffness();
  const double depth = std::pow(1.25 * kBallMass * speed * speed / k, 0.4);
  return std::sqrt(1.5 * k * std::sqrt(depth) / kBallMass);
}

TEST(ExplicitImpact, NamesTheStableStepAtThePeak) {
  const auto central = find_warnings(IntegratorKind::central_differences, 2e-7);
  EXPECT_NEAR(find_named_step(central) * find_omega() / 2.0, 1.0, 0.01);
  EXPECT_THAT(central, ::testing::Contains(HasSubstr("floor/ball")));
  const auto fourth = find_warnings(IntegratorKind::runge_kutta_4, 2e-7);
  EXPECT_NEAR(find_named_step(fourth) * find_omega() / 2.6, 1.0, 0.02);
}

// A peak force of millinewtons, at a depth of nanometres, near the length by
// which the stiffness is looked for.
TEST(ExplicitImpact, NamesItForTheLightestTouch) {
  constexpr double kSpeed = 3e-5;
  const auto central =
      find_warnings(IntegratorKind::central_differences, 2e-6, kSpeed);
  EXPECT_NEAR(find_named_step(central) * find_omega(kSpeed) / 2.0, 1.0, 0.03);
}

TEST(ExplicitImpact, IsNoMatterOfImplicitSchemes) {
  EXPECT_EQ(
      find_named_step(find_warnings(IntegratorKind::generalized_alpha, 2e-7)),
      0.0);
}

}  // namespace
}  // namespace limber::contact::explicit_impact_test
