// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/law/impact_estimate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "limber/common/errors.hpp"
#include "limber/contact/law/materials.hpp"
#include "unit/contact/law/two_body_impact.hpp"

namespace limber::contact::impact_estimate_test {
namespace {

using test::TwoBodyImpact;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kPi = std::numbers::pi;

double find_hertz_duration(double k, double mass, double speed) {
  const double depth = std::pow(1.25 * mass * speed * speed / k, 0.4);
  const double number =
      0.8 * std::sqrt(kPi) * std::tgamma(0.4) / std::tgamma(0.9);
  return number * depth / speed;
}

// Johnson (1985, ch. 11): d_p = (15 m v^2 / (16 sqrt(R) E*))^(2/5),
// T = 2.94 d_p / v = 2.87 (m^2 / (R E*^2 v))^(1/5).
TEST(ImpactEstimate, WithoutResidualItIsHertzs) {
  const double modulus = 115e9;
  const double radius = 0.01;
  const double k = find_hertz_stiffness(modulus, radius);
  for (const double speed : {1e-4, 1.0, 100.0}) {
    for (const double mass : {1e-3, 0.5}) {
      const auto impact =
          estimate_impact(HertzLaw({.stiffness = k}), mass, speed);
      const double depth = std::pow(
          15.0 * mass * speed * speed / (16.0 * std::sqrt(radius) * modulus),
          0.4);
      EXPECT_NEAR(impact.peak_depth / depth, 1.0, 1e-13);
      EXPECT_NEAR(impact.peak_force / (k * std::pow(depth, 1.5)), 1.0, 1e-13);
      EXPECT_NEAR(impact.duration * speed / depth, 2.94, 5e-3);
      EXPECT_NEAR(impact.duration / find_hertz_duration(k, mass, speed), 1.0,
                  1e-11);
      EXPECT_NEAR(
          impact.duration /
              std::pow(mass * mass / (radius * modulus * modulus * speed), 0.2),
          2.87, 5e-3);
      EXPECT_NEAR(
          impact.duration / std::pow(mass * mass / (k * k * speed), 0.2), 3.218,
          5e-4);
    }
  }
}

TEST(ImpactEstimate, OfAResidualAloneItIsHalfAPeriodAtAnySpeed) {
  const HertzLaw law({.stiffness = HertzLaw::kRigid, .residual = 3e-8});
  for (const double speed : {1e-4, 1.0, 100.0}) {
    const auto impact = estimate_impact(law, 0.2, speed);
    EXPECT_NEAR(impact.duration / (kPi * std::sqrt(0.2 * 3e-8)), 1.0, 1e-11);
    EXPECT_NEAR(impact.peak_force / (speed * std::sqrt(0.2 / 3e-8)), 1.0,
                1e-13);
  }
}

TEST(ImpactEstimate, ItIsWhatTheMotionIntegratesTo) {
  for (const double R : {0.0, 1e-9, 1e-8, 1e-6, 1e-3}) {
    for (const double speed : {1e-3, 3.0}) {
      const HertzLaw law({.stiffness = 3e9, .residual = R});
      const auto impact = estimate_impact(law, 0.5 * 0.8 / 1.3, speed);
      const auto out = TwoBodyImpact(law, 0.0, 0.5, 0.8).run(speed);
      EXPECT_NEAR(out.duration / impact.duration, 1.0, 1e-7);
      EXPECT_NEAR(out.peak_force / impact.peak_force, 1.0, 1e-5);
      EXPECT_NEAR(out.peak_depth / impact.peak_depth, 1.0, 1e-5);
    }
  }
}

TEST(ImpactEstimate, TheDurationIsBetweenTheBoundsOfItsParts) {
  const double k = 3e9;
  const double mass = 0.3;
  double widest = 0.0;
  for (double R = 1e-13; R < 1.0; R *= 5.0) {
    for (const double speed : {1e-4, 0.1, 100.0}) {
      const double T =
          estimate_impact(HertzLaw({.stiffness = k, .residual = R}), mass,
                          speed)
              .duration;
      const double hertz = find_hertz_duration(k, mass, speed);
      const double residual = kPi * std::sqrt(mass * R);
      EXPECT_GE(T, std::hypot(hertz, residual) * (1.0 - 1e-10));
      EXPECT_LE(T, (hertz + residual) * (1.0 + 1e-10));
      widest = std::max(widest, T / std::hypot(hertz, residual));
    }
  }
  EXPECT_GT(widest, 1.01);  // the bounds are not the answer itself
}

TEST(ImpactEstimate, BadValuesAreRefused) {
  const HertzLaw law({.stiffness = 1.0});
  for (const double bad : {0.0, -1.0, kNaN, kInf}) {
    EXPECT_THROW(static_cast<void>(estimate_impact(law, bad, 1.0)),
                 ContractError);
    EXPECT_THROW(static_cast<void>(estimate_impact(law, 1.0, bad)),
                 ContractError);
  }
}

}  // namespace
}  // namespace limber::contact::impact_estimate_test
