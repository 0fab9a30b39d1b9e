// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/restitution.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

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

// By an independent program: Simpson's rule in 4000 intervals of the angle of
// v and sqrt(2 W / m).
TEST(RestitutionFactor, IsThatOfTheTable) {
  constexpr std::array<std::pair<double, double>, 13> kTable = {{
      {0.99, 0.01508},
      {0.95, 0.07691},
      {0.9, 0.15774},
      {0.85, 0.24268},
      {0.8, 0.33190},
      {0.7, 0.52372},
      {0.6, 0.73414},
      {0.5, 0.96355},
      {0.4, 1.24201},
      {0.3, 1.67063},
      {0.2, 2.43212},
      {0.1, 4.29101},
      {0.05, 7.17297},
  }};
  for (const auto& [e, beta] : kTable) {
    EXPECT_NEAR(find_restitution_factor(e), beta, 6e-6 * (1.0 + beta)) << e;
  }
}

// Of the mass, the law W = d^n and the speed, by the classical Runge-Kutta
// scheme: d'' = -f (1 + beta d' / sqrt(d'^2 + 2 W / m)) / m.
double rebound(double beta, double exponent, double mass, double speed) {
  const auto find_rate = [&](const std::array<double, 2>& x) {
    const double d = std::max(x[0], 0.0);
    const double W = std::pow(d, exponent);
    const double f = exponent * std::pow(d, exponent - 1.0);
    const double root = std::sqrt(x[1] * x[1] + 2.0 * W / mass);
    const double grip = std::max(0.0, 1.0 + beta * x[1] / root);
    return std::array<double, 2>{x[1], -f * grip / mass};
  };
  const double depth = std::pow(0.5 * mass * speed * speed, 1.0 / exponent);
  const double h = 3e-4 * depth / speed;
  std::array<double, 2> x = {0.0, speed};
  const auto shifted = [&](const std::array<double, 2>& by, double dt) {
    return std::array<double, 2>{x[0] + dt * by[0], x[1] + dt * by[1]};
  };
  do {
    const auto k1 = find_rate(x);
    const auto k2 = find_rate(shifted(k1, 0.5 * h));
    const auto k3 = find_rate(shifted(k2, 0.5 * h));
    const auto k4 = find_rate(shifted(k3, h));
    for (std::size_t i = 0; i < 2; ++i) {
      x[i] += h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
    }
  } while (x[0] > 0.0);
  return -x[1] / speed;
}

TEST(RestitutionFactor, PartsAtERegardlessOfLawMassAndSpeed) {
  for (const double e : {0.99, 0.9, 0.8, 0.5, 0.3, 0.1, 0.05}) {
    const double beta = find_restitution_factor(e);
    for (const double exponent : {2.0, 2.25, 2.5, 4.0}) {
      for (const double speed : {1e-4, 0.03, 10.0}) {
        for (const double mass : {0.02, 7.0}) {
          EXPECT_NEAR(rebound(beta, exponent, mass, speed), e, 1e-6)
              << exponent << " " << speed;
        }
      }
    }
  }
}

TEST(RestitutionFactor, IsZeroAtOneAndLinearNearIt) {
  EXPECT_EQ(find_restitution_factor(1.0), 0.0);
  for (const double loss : {1e-3, 1e-5}) {
    EXPECT_NEAR(find_restitution_factor(1.0 - loss) / (1.5 * loss), 1.0,
                1.5 * loss + 1e-5);
  }
}

TEST(RestitutionFactor, IsThatOfTheLeastBelowIt) {
  for (const double e : {0.0, 1e-9, 0.0499}) {
    EXPECT_EQ(find_restitution_factor(e),
              find_restitution_factor(kLeastRestitution));
  }
}

TEST(RestitutionFactor, FallsWithRestitutionWithoutAJump) {
  double last = find_restitution_factor(kLeastRestitution);
  for (double e = kLeastRestitution; e < 1.0; e += 1e-3) {
    const double beta = find_restitution_factor(e);
    EXPECT_LE(beta, last);
    EXPECT_GT(beta, 0.95 * last - 2e-3) << e;
    last = beta;
  }
}

TEST(RestitutionFactor, ValuesOutsideItsRangeAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {-1e-9, 1.0000001, HUGE_VAL, nan}) {
    EXPECT_THROW(static_cast<void>(find_restitution_factor(bad)),
                 ContractError);
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
