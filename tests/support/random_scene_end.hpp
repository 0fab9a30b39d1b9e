// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gmock/gmock.h>

#include <algorithm>

#include "support/random_scene.hpp"
#include "support/run_random_scene.hpp"

namespace limber::testing {

/// Solves of one attempt at a step, after which the budget is checked again:
/// twice 20 iterations with 60 Krylov vectors, each with its own few.
inline constexpr long kSolvesOfAnAttempt = 2 * 20 * 64;

/// Expects that a scene ended with finite results, or with an error that names
/// a body or a coupler or what energy is open, within the work allowed by
/// dynamics/stepping/work_budget.hpp.
inline void expect_good_end(const RandomScene& scene,
                            const RandomOutcome& outcome) {
  using ::testing::AnyOf;
  using ::testing::HasSubstr;
  EXPECT_NE(outcome.kind, RandomOutcome::Kind::failed) << outcome.text;
  EXPECT_FALSE(is_silent_about_drift(outcome)) << outcome.drift << " J";
  if (outcome.kind == RandomOutcome::Kind::refused) {
    EXPECT_THAT(outcome.text, AnyOf(HasSubstr("body '"), HasSubstr("joint"),
                                    HasSubstr("energy does not balance")));
    EXPECT_THAT(outcome.text, HasSubstr(" s"));
  }
  const dynamics::SimulationStatistics& cost = outcome.statistics;
  const long steps = cost.steps + cost.rejected_steps;
  const long passes = std::max(cost.passes, 1);
  const auto bodies = static_cast<long>(scene.model.bodies.size());
  EXPECT_LE(cost.linear_solves, passes * (2'000'000 / bodies) + 300 * steps +
                                    passes * kSolvesOfAnAttempt);
  if (scene.settings.tolerance > 0.0) {
    EXPECT_LE(steps, scene.settings.most_steps + passes);
  }
}

inline void expect_good_end(unsigned seed) {
  expect_good_end(draw_scene(seed), run_random_scene(seed));
}

}  // namespace limber::testing
