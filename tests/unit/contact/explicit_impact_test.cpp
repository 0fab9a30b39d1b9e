// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <cmath>
#include <string>

#include "limber/dynamics/simulation/run_record.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "unit/contact/ball_on_floor.hpp"

/// Explicit schemes and the stiffness of a contact, against Hertz's.
namespace limber::contact {
namespace {

using dynamics::IntegratorKind;
using testing::BallOnFloor;
using ::testing::HasSubstr;
using testing::kBallMass;

std::vector<std::string> find_warnings(IntegratorKind scheme, double step) {
  BallOnFloor scene({}, {0.0, 0.0, -1.0});
  dynamics::SimulationSettings settings;
  settings.end_time = 1e-4;
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
double find_omega() {
  const double k = testing::hertz_stiffness();
  const double depth = std::pow(1.25 * kBallMass / k, 0.4);
  return std::sqrt(1.5 * k * std::sqrt(depth) / kBallMass);
}

TEST(ExplicitImpact, NamesTheStableStepAtThePeak) {
  const auto central = find_warnings(IntegratorKind::central_differences, 2e-7);
  EXPECT_NEAR(find_named_step(central) * find_omega() / 2.0, 1.0, 0.01);
  EXPECT_THAT(central, ::testing::Contains(HasSubstr("floor/ball")));
  const auto fourth = find_warnings(IntegratorKind::runge_kutta_4, 2e-7);
  EXPECT_NEAR(find_named_step(fourth) * find_omega() / 2.6, 1.0, 0.02);
}

TEST(ExplicitImpact, IsNoMatterOfImplicitSchemes) {
  EXPECT_EQ(
      find_named_step(find_warnings(IntegratorKind::generalized_alpha, 2e-7)),
      0.0);
}

}  // namespace
}  // namespace limber::contact
