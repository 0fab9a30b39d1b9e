// SPDX-License-Identifier: BSD-3-Clause
// Random scenes that were hard, of those that bench_random_scenes runs.
#include <gtest/gtest.h>

#include "support/random_scene_end.hpp"

namespace limber::testing::random_scene_test {
namespace {

class RandomScene : public ::testing::TestWithParam<unsigned> {};

TEST_P(RandomScene, EndsWithNumbersOrWordsAfterBoundedWork) {
  expect_good_end(GetParam());
}

// Most work a step among those that finish.
INSTANTIATE_TEST_SUITE_P(Hardest, RandomScene,
                         ::testing::Values(7U, 194U, 201U, 317U, 368U));

// One of each kind of refusal.
INSTANTIATE_TEST_SUITE_P(Refused, RandomScene,
                         ::testing::Values(4U, 10U, 13U, 19U, 33U, 41U, 42U,
                                           52U, 83U, 85U));

class ClashingScene : public ::testing::TestWithParam<unsigned> {};

TEST_P(ClashingScene, FinishesFromVelocitiesThatDampersAllow) {
  const RandomOutcome outcome = run_random_scene(GetParam());
  EXPECT_EQ(outcome.kind, RandomOutcome::Kind::finished) << outcome.text;
  EXPECT_THAT(
      outcome.statistics.warnings,
      ::testing::Contains(::testing::HasSubstr("to what the dampers allow")));
}

INSTANTIATE_TEST_SUITE_P(Seeds, ClashingScene,
                         ::testing::Values(168U, 210U, 288U, 323U));

// An explicit scheme is left to run against it.
TEST(RandomSceneText, NamesTheCouplerWhoseDamperBodiesStartAgainst) {
  const RandomOutcome outcome = run_random_scene(346);
  EXPECT_EQ(outcome.kind, RandomOutcome::Kind::refused);
  EXPECT_THAT(outcome.text,
              ::testing::HasSubstr("start with velocities that coupler"));
}

}  // namespace
}  // namespace limber::testing::random_scene_test
