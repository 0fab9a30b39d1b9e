// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/law/torsional_friction.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "limber/common/errors.hpp"
#include "limber/contact/law/materials.hpp"
#include "support/differences.hpp"

namespace limber::contact::torsional_friction_test {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kPi = std::numbers::pi;

// The integral of mu p r over Hertz's pressure, p = p0 sqrt(1 - r^2/a^2) with
// p0 = 3 f / (2 pi a^2), by the midpoint rule in r = a sin(x).
TEST(TorsionalFriction, TheMomentOfFullSlipIsThatOfHertzsPressure) {
  const double f = 50.0;
  const double a = 2e-4;
  const double mu = 0.3;
  double moment = 0.0;
  const int count = 2000;
  for (int i = 0; i < count; ++i) {
    const double x = 0.5 * kPi * (i + 0.5) / count;
    const double r = a * std::sin(x);
    const double p = 1.5 * f / (kPi * a * a) * std::cos(x);
    moment += mu * p * r * 2.0 * kPi * r * a * std::cos(x) * 0.5 * kPi / count;
  }
  const TorsionalFriction friction({.friction = mu, .stiffness = 100.0});
  const TwistResponse r = friction.evaluate(
      {}, {.increment = 1.0, .normal_force = f, .contact_radius = a});
  EXPECT_TRUE(r.slips);
  EXPECT_NEAR(-r.moment / moment, 1.0, 1e-6);
}

// Johnson (1985, ch. 7), a sphere on its like: 16 G a^3 / 3 for each, so half.
TEST(TorsionalFriction, ASmallTurnMeetsTheStiffness) {
  const SurfaceMaterial steel{.youngs_modulus = 210e9, .poisson_ratio = 0.3};
  const double G = 210e9 / 2.6;
  const double a = 1e-4;
  const double k =
      16.0 / 3.0 * a * a * a * find_pair_moduli(steel, steel)->torsional;
  EXPECT_NEAR(k / (8.0 / 3.0 * G * a * a * a), 1.0, 1e-14);
  const TorsionalFriction friction({.friction = 0.3, .stiffness = k});
  const TwistResponse r = friction.evaluate(
      {.twist = 2e-6},
      {.increment = 1e-6, .normal_force = 100.0, .contact_radius = a});
  EXPECT_FALSE(r.slips);
  EXPECT_NEAR(r.moment / (-3e-6 * k), 1.0, 1e-14);
  EXPECT_NEAR(r.next.twist, 3e-6, 1e-20);
}

TEST(TorsionalFriction, DerivativesAreConsistentWithTheReturn) {
  const TorsionalFriction friction(
      {.friction = 0.3, .stiffness = 2.0, .damping = 0.01});
  const double a100 = 1e-3;  // at 100 N
  int slips = 0;
  for (const double increment : {1e-3, 5e-3, -0.2, 0.3}) {
    for (const double velocity : {-0.1, 0.2}) {
      const auto at = [&](double x, double y, double z) {
        const double f = 100.0 * (1.0 + z);
        return friction.evaluate({.twist = 1e-3},
                                 {.increment = increment + x,
                                  .velocity = velocity + y,
                                  .normal_force = f,
                                  .contact_radius = a100 * std::cbrt(1.0 + z)});
      };
      const TwistResponse r = at(0.0, 0.0, 0.0);
      using limber::testing::differentiate;
      EXPECT_NEAR(
          differentiate([&](double x) { return at(x, 0, 0).moment; }, 1e-5),
          r.by_increment, 1e-9);
      EXPECT_NEAR(
          differentiate([&](double x) { return at(0, x, 0).moment; }, 1e-5),
          r.by_velocity, 1e-9);
      EXPECT_NEAR(
          differentiate([&](double x) { return at(0, 0, x).moment; }, 1e-3) /
              100.0,
          r.by_normal_force, 1e-12);
      slips += r.slips ? 1 : 0;
    }
  }
  EXPECT_GT(slips, 2);
  EXPECT_LT(slips, 8);
}

TEST(TorsionalFriction, WorkIsStoredOrLostAndNeverGained) {
  const TorsionalFriction friction(
      {.friction = 0.3, .stiffness = 2.0, .damping = 0.01});
  std::mt19937_64 generator(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  TwistMemory memory;
  const double h = 1e-2;
  int slips = 0;
  for (int i = 0; i < 2000; ++i) {
    const double increment = 0.02 * uniform(generator);
    const TwistResponse r =
        friction.evaluate(memory, {.increment = increment,
                                   .velocity = increment / h,
                                   .normal_force = 100.0,
                                   .contact_radius = 1e-3});
    const double before = memory.twist * memory.twist;  // k = 2
    const double rest = std::pow(r.next.twist - memory.twist, 2);
    EXPECT_NEAR(-r.moment * increment,
                r.energy - before + r.slip_work + h * r.damper_power + rest,
                1e-15);
    EXPECT_GE(r.slip_work, 0.0);
    EXPECT_GE(r.damper_power, 0.0);
    slips += r.slips ? 1 : 0;
    memory = r.next;
  }
  EXPECT_GT(slips, 100);
  EXPECT_LT(slips, 1900);
}

TEST(TorsionalFriction, BadValuesAreRefused) {
  const auto expect_refused = [](const TorsionalFriction::Parameters& p) {
    EXPECT_THROW(static_cast<void>(TorsionalFriction(p)), InputError);
  };
  for (const double bad : {-0.1, kNaN, kInf}) {
    expect_refused({.friction = bad, .stiffness = 1.0});
    expect_refused({.stiffness = 1.0, .damping = bad});
  }
  for (const double bad : {0.0, -1.0, kNaN, kInf}) {
    expect_refused({.stiffness = bad});
  }
}

}  // namespace
}  // namespace limber::contact::torsional_friction_test
