// SPDX-License-Identifier: BSD-3-Clause
// Random scenes that would not end within a minute before work was bounded, and
// the slowest of the rest.
#include <gtest/gtest.h>

#include "support/random_scene_end.hpp"

namespace limber::testing {
namespace {

class LongRandomScene : public ::testing::TestWithParam<unsigned> {};

TEST_P(LongRandomScene, EndsWithNumbersOrWordsAfterBoundedWork) {
  expect_good_end(GetParam());
}

INSTANTIATE_TEST_SUITE_P(Unbounded, LongRandomScene,
                         ::testing::Values(1146U, 1517U, 1957U, 2499U, 2680U,
                                           3472U, 4529U, 4826U, 4956U, 5333U,
                                           6026U, 8002U, 8836U, 9329U, 9348U));

INSTANTIATE_TEST_SUITE_P(Slow, LongRandomScene,
                         ::testing::Values(9U, 38U, 48U, 87U, 252U, 268U, 394U,
                                           481U));

}  // namespace
}  // namespace limber::testing
