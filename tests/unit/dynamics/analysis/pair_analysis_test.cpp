// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "limber/dynamics/analysis/natural_frequencies.hpp"
#include "support/paired_bodies.hpp"

/// Springs of a pair are those of as many couplers in vibration.
namespace limber::dynamics::pair_analysis_test {
namespace {

using testing::make_paired_bodies;
using testing::PairedBodies;

TEST(PairVibration, VibrateAsCouplersDo) {
  const testing::PairedBodiesOptions options{.damping = 3.0, .spin = 0.0};
  testing::PairedBodiesOptions couplers = options;
  couplers.by_pairs = false;
  const PairedBodies a = make_paired_bodies(options);
  const PairedBodies b = make_paired_bodies(couplers);
  const VectorX of_pairs = find_natural_frequencies(a.model, a.state);
  const VectorX of_couplers = find_natural_frequencies(b.model, b.state);
  ASSERT_EQ(of_pairs.size(), of_couplers.size());
  EXPECT_LT((of_pairs - of_couplers).norm(), 1e-9 * of_couplers.norm());
  const auto damped = find_natural_modes(a.model, a.state).modes;
  const auto same = find_natural_modes(b.model, b.state).modes;
  ASSERT_EQ(damped.size(), same.size());
  for (std::size_t i = 0; i < damped.size(); ++i) {
    EXPECT_LT(std::abs(damped[i].value - same[i].value),
              1e-8 * std::abs(same.back().value));
  }
}

}  // namespace
}  // namespace limber::dynamics::pair_analysis_test
