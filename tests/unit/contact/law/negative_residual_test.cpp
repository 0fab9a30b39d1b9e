// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "limber/contact/law/hertz_law.hpp"
#include "support/differences.hpp"

/// Of a basis that has part of the flattening already.
namespace limber::contact::negative_residual_test {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();

std::vector<HertzLaw> make_laws() {
  std::vector<HertzLaw> laws;
  for (const double k : {1e3, 1e7, 3e10}) {
    for (const double R : {-1e-14, -2e-10, -1e-6}) {
      laws.emplace_back(HertzLaw::Parameters{.stiffness = k, .residual = R});
    }
  }
  return laws;
}

// cbrt(f) and depth where the cubic ends.
double find_root_limit(const HertzLaw& law) {
  const auto& p = law.parameters();
  return std::pow(p.stiffness, -2.0 / 3.0) / (-3.0 * p.residual);
}
double find_depth_limit(const HertzLaw& law) {
  const double s = find_root_limit(law);
  const auto& p = law.parameters();
  return std::pow(p.stiffness, -2.0 / 3.0) * s * s + p.residual * s * s * s;
}

TEST(NegativeResidual, TheForceOfADepthIsRightToRoundoffWithinTheCubic) {
  double worst = 0.0;
  for (const HertzLaw& law : make_laws()) {
    const auto& p = law.parameters();
    const double end = find_depth_limit(law);
    for (double fraction = 1e-9; fraction < 1.0; fraction *= 1.9) {
      const long double f = law.evaluate(fraction * end).force;
      const long double depth =
          std::pow(f / p.stiffness, 2.0L / 3.0L) + p.residual * f;
      worst = std::max(
          worst,
          std::abs(static_cast<double>(depth / (fraction * end) - 1.0L)));
    }
  }
  EXPECT_LE(worst, 16.0 * kEps);
}

TEST(NegativeResidual, IsStifferThanHertzAlone) {
  for (const HertzLaw& law : make_laws()) {
    const HertzLaw hertz({.stiffness = law.parameters().stiffness});
    for (const double fraction : {1e-3, 0.1, 0.9, 2.0}) {
      const double d = fraction * find_depth_limit(law);
      EXPECT_GT(law.evaluate(d).force, hertz.evaluate(d).force);
    }
  }
}

TEST(NegativeResidual, TheForceIsTheEnergysDerivativeThroughTheCubicsEnd) {
  for (const HertzLaw& law : make_laws()) {
    const double end = find_depth_limit(law);
    for (const double fraction : {0.01, 0.5, 0.97, 1.03, 2.0, 50.0}) {
      const double d = fraction * end;
      const auto energy = [&](double x) {
        return law.evaluate(d * (1.0 + x)).energy();
      };
      const auto force = [&](double x) {
        return law.evaluate(d * (1.0 + x)).force;
      };
      const HertzLaw::Response r = law.evaluate(d);
      EXPECT_NEAR(testing::differentiate(energy, 1e-3) / (r.force * d), 1.0,
                  1e-9);
      EXPECT_NEAR(testing::differentiate(force, 1e-3) / (r.stiffness * d), 1.0,
                  1e-8);
      EXPECT_NEAR((r.hertz_depth + r.residual_depth) / d, 1.0, 1e-14);
    }
    const double below = law.evaluate(end * (1.0 - 1e-12)).stiffness;
    const double above = law.evaluate(end * (1.0 + 1e-12)).stiffness;
    EXPECT_NEAR(below / above, 1.0, 1e-5);
  }
}

TEST(NegativeResidual, AnEnergyGivesTheStateThatStoresIt) {
  for (const HertzLaw& law : make_laws()) {
    for (const double fraction : {1e-9, 1e-3, 0.5, 0.99, 1.01, 3.0, 1e3}) {
      const HertzLaw::Response at =
          law.evaluate(fraction * find_depth_limit(law));
      const HertzLaw::Response back = law.find_state_of_energy(at.energy());
      EXPECT_NEAR(back.force / at.force, 1.0, 1e-12) << fraction;
      EXPECT_NEAR(back.energy() / at.energy(), 1.0, 1e-13) << fraction;
    }
  }
}

}  // namespace
}  // namespace limber::contact::negative_residual_test
