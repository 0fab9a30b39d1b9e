// SPDX-License-Identifier: BSD-3-Clause
// Random scenes that would not end within a minute before work was bounded, and
// slow ones of the rest. The slowest of both, seeds 481, 2499, 2680, 4529, 4956
// and 8002, are among the 10 000 of scripts/nightly.
#include <gtest/gtest.h>

#include "support/random_scene_end.hpp"

namespace limber::testing::random_scene_nightly {
namespace {

class LongRandomScene : public ::testing::TestWithParam<unsigned> {};

TEST_P(LongRandomScene, EndsWithNumbersOrWordsAfterBoundedWork) {
  expect_good_end(GetParam());
}

INSTANTIATE_TEST_SUITE_P(Unbounded, LongRandomScene,
                         ::testing::Values(1146U, 1517U, 1957U, 3472U, 4826U,
                                           5333U, 6026U, 8836U, 9329U, 9348U));

INSTANTIATE_TEST_SUITE_P(Slow, LongRandomScene,
                         ::testing::Values(9U, 38U, 48U, 87U, 252U, 268U,
                                           394U));

}  // namespace
}  // namespace limber::testing::random_scene_nightly
