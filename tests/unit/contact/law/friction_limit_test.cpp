// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/law/friction_limit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/differences.hpp"

namespace limber::contact::friction_limit_test {
namespace {

// Stribeck's curve: mu_s at rest, mu_k + (mu_s - mu_k) / e at its speed.
TEST(FrictionLimit, FallsFromRestToSliding) {
  for (const double excess : {0.0, 0.004, 0.01, 0.2}) {
    const FrictionLimit limit{.sliding = 0.3, .excess = excess, .speed = 0.02};
    const auto at = [&](double speed) {
      return find_coefficient(limit, speed).value;
    };
    EXPECT_EQ(at(0.0), 0.3 + excess);
    EXPECT_NEAR(at(0.02), 0.3 + excess / std::exp(1.0), 1e-15);
    EXPECT_NEAR(at(0.04), 0.3 + excess / std::exp(4.0), 1e-15);
    EXPECT_NEAR(at(1.0), 0.3, 1e-15);
  }
}

TEST(FrictionLimit, HasTheSlopeOfItsValue) {
  const FrictionLimit limit{.sliding = 0.3, .excess = 0.1, .speed = 0.02};
  for (const double speed : {0.0, 1e-3, 0.02, 0.05}) {
    const auto value = [&](double x) {
      return find_coefficient(limit, speed + x).value;
    };
    EXPECT_NEAR(find_coefficient(limit, speed).slope,
                testing::differentiate(value, 1e-4), 1e-6);
  }
}

}  // namespace
}  // namespace limber::contact::friction_limit_test
