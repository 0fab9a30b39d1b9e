// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "support/free_chain.hpp"

namespace limber::dynamics::energy_conserving_nightly {
namespace {

// A random walk of round-off in the wrenches of stiff couplers: at five steps
// that differ by 3 % it ends between 1.0e-10 and 2.7e-10.
TEST(AMillionSteps, OfTheEnergyConservingSchemeKeepAFreeChainsEnergyTo5e10) {
  const testing::FreeChain chain = testing::make_free_chain(1e7, 1.0, 0.1);
  const testing::KeptDrift drift = testing::find_energy_conserving_drift(
      chain, 20.0 * chain.shortest, 1000000);
  EXPECT_LT(drift.energy, 5e-10);
  EXPECT_LT(drift.linear, 1e-12);
  EXPECT_LT(drift.angular, 1e-10);
}

}  // namespace
}  // namespace limber::dynamics::energy_conserving_nightly
