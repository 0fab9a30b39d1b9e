// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/restitution.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "limber/common/errors.hpp"

namespace limber::restitution_test {
namespace {

// The speed is what a whole bounce leaves: int v / (1 + b v) dv is the same
// from 0 to v and from -e v to 0; here by Simpson's rule.
TEST(Restitution, BothWaysStoreTheSameEnergy) {
  for (const double e : {0.05, 0.1, 0.5, 0.9, 0.99}) {
    const double speed = 3.0;
    const double b = find_restitution_damping(e, speed);
    const auto integrate = [&](double from, double to) {
      const int count = 200000;
      const double h = (to - from) / count;
      double sum = 0.0;
      for (int i = 0; i <= count; ++i) {
        const double v = from + h * i;
        const double weight = i == 0 || i == count ? 1.0 : 2.0 + 2.0 * (i % 2);
        sum += weight * v / (1.0 + b * v);
      }
      return sum * h / 3.0;
    };
    EXPECT_LT(b * e * speed, 1.0);
    if (e < 0.2) continue;  // singular within round-off of -e v
    EXPECT_NEAR(integrate(0.0, speed) / -integrate(-e * speed, 0.0), 1.0, 1e-9);
  }
}

TEST(Restitution, ValuesOutsideTheirRangeAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {0.0, -0.5, 1.5, nan}) {
    EXPECT_THROW(static_cast<void>(find_restitution_damping(bad, 1.0)),
                 ContractError);
  }
  for (const double bad : {0.0, -0.5, HUGE_VAL, nan}) {
    EXPECT_THROW(static_cast<void>(find_restitution_damping(0.5, bad)),
                 ContractError);
  }
  EXPECT_EQ(find_restitution_damping(1.0, 2.0), 0.0);
}

}  // namespace
}  // namespace limber::restitution_test
