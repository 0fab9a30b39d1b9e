// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <tuple>
#include <utility>

#include "limber/dynamics/simulation/run_record.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "unit/contact/flat_rod.hpp"

/// A rod that strikes a rigid wall, a heavy box or another rod flat at 1 m/s,
/// against the wave solution, force E A v / c for 2 L / c, of two rods half of
/// it. All its modes without roll-off give peaks of 1.85 to 1.89 of it.
namespace limber::contact::rod_end_test {
namespace {

using test::kDuration;
using test::kForce;
using test::Target;

struct Impact {
  dynamics::ContactRecord record;
  std::size_t count = 0;
};

Impact strike(int modes, Target target, dynamics::IntegratorKind scheme,
              double step) {
  test::RodScene scene = test::make_rod_scene(modes, target, {});
  dynamics::SimulationSettings settings;
  settings.integrator = scheme;
  settings.rho_inf = 1.0;
  settings.step = step;
  settings.end_time = 2.0 * kDuration;
  dynamics::RunRecord record;
  dynamics::SimulationStatistics statistics;
  dynamics::simulate(scene.model, scene.state, settings, {}, {}, statistics, {},
                     {}, record);
  EXPECT_GE(record.contacts.size(), 1U);
  return {record.contacts.front(), record.contacts.size()};
}

class RodEnd : public ::testing::TestWithParam<
                   std::tuple<Target, std::pair<int, double>>> {};

TEST_P(RodEnd, StrikesOnceAsTheWaveSolutionSays) {
  const auto [target, known] = GetParam();
  const auto [modes, longer] = known;
  const double force = target == Target::rod ? 0.5 * kForce : kForce;
  for (const auto scheme : {dynamics::IntegratorKind::generalized_alpha,
                            dynamics::IntegratorKind::energy_conserving}) {
    const Impact impact = strike(modes, target, scheme, kDuration / 2000.0);
    EXPECT_EQ(impact.count, 1U);
    EXPECT_EQ(impact.record.touches, 1);
    EXPECT_GE(impact.record.peak_force / force, 1.0);
    EXPECT_LE(impact.record.peak_force / force, 1.1);
    EXPECT_GE(impact.record.duration / kDuration, 1.0);
    EXPECT_LE(impact.record.duration / kDuration, longer);
    EXPECT_NEAR(impact.record.impulse / (force * kDuration), 1.0, 0.002);
    EXPECT_GE(impact.record.restitution().value_or(0.0), 0.998);
  }
}

INSTANTIATE_TEST_SUITE_P(
    TargetsAndModes, RodEnd,
    ::testing::Combine(
        ::testing::Values(Target::wall, Target::box, Target::rod),
        ::testing::Values(std::pair{5, 1.07}, std::pair{10, 1.045},
                          std::pair{20, 1.025})));

}  // namespace
}  // namespace limber::contact::rod_end_test
