// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/errors/error_runs.hpp"

#include <gmock/gmock.h>

namespace limber::app::error_runs_test {
namespace {

using ::testing::HasSubstr;

/// Of a throughput of 1 J.
dynamics::EnergyDrift make_drift(double drift) {
  dynamics::EnergyDrift energy;
  energy.drift.value = drift;
  energy.drift.time = 0.25;
  energy.throughput = 1.0;
  return energy;
}

TEST(ImbalanceOfAFinerRun, IsToldAboveOnePercentAndTwiceThatOfOnesOwn) {
  EXPECT_FALSE(find_imbalance(make_drift(0.009), make_drift(0.0)));
  EXPECT_FALSE(find_imbalance(make_drift(-0.009), make_drift(0.0)));
  EXPECT_TRUE(find_imbalance(make_drift(0.011), make_drift(0.0)));
  EXPECT_FALSE(find_imbalance(make_drift(0.039), make_drift(-0.02)));
  EXPECT_TRUE(find_imbalance(make_drift(0.041), make_drift(-0.02)));
}

TEST(ImbalanceOfAFinerRun, IsToldWithItsShareSignAndTime) {
  EXPECT_THAT(*find_imbalance(make_drift(0.4), make_drift(0.0)),
              HasSubstr("40 % of its energy is gained by t = 0.25 s"));
  EXPECT_THAT(*find_imbalance(make_drift(-0.4), make_drift(0.0)),
              HasSubstr("lost"));
}

}  // namespace
}  // namespace limber::app::error_runs_test
