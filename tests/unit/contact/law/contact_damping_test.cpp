// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/law/contact_damping.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "limber/common/restitution.hpp"
#include "support/differences.hpp"
#include "unit/contact/law/two_body_impact.hpp"

namespace limber::contact::contact_damping_test {
namespace {

using test::TwoBodyImpact;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// Hertz alone, with a residual of the same size, of one that prevails, and a
// residual alone.
std::vector<HertzLaw> make_laws() {
  return {HertzLaw({.stiffness = 2e9}),
          HertzLaw({.stiffness = 2e9, .residual = 2e-8}),
          HertzLaw({.stiffness = 2e9, .residual = 1e-5}),
          HertzLaw({.stiffness = HertzLaw::kRigid, .residual = 1e-7})};
}

TEST(ContactDamping, TwoFreeBodiesPartWithTheRestitutionAskedFor) {
  limber::testing::Margin restitution;
  limber::testing::Margin momentum;
  limber::testing::Margin energy;
  for (const HertzLaw& law : make_laws()) {
    for (const double e : {1.0, 0.9, 0.7, 0.5, 0.3, 0.1, 0.05}) {
      const double beta = find_restitution_factor(e);
      for (const double speed : {1e-4, 1e-3, 4.0}) {
        for (const double mass_B : {0.2, 50.0}) {
          const double mass_A = 0.3;
          const auto out = TwoBodyImpact(law, beta, mass_A, mass_B).run(speed);
          ASSERT_GT(out.steps, 100);
          EXPECT_GE(out.least_force, 0.0);
          restitution.add(std::abs((out.speed_B - out.speed_A) / speed - e) / e,
                          1.0);
          momentum.add(std::abs((mass_A * out.speed_A + mass_B * out.speed_B) /
                                    (mass_A * speed) -
                                1.0),
                       1.0);
          const double before = 0.5 * mass_A * speed * speed;
          const double after = 0.5 * mass_A * out.speed_A * out.speed_A +
                               0.5 * mass_B * out.speed_B * out.speed_B;
          energy.add(std::abs((after + out.dissipated) / before - 1.0), 1.0);
        }
      }
    }
  }
  restitution.expect_below(1e-6);
  momentum.expect_below(1e-12);
  energy.expect_below(1e-8);
}

// sqrt(d'^2 + 2 W / m) is at least |d'|: however slow or deep, s d' is bounded.
TEST(ContactDamping, ChangesTheForceByBetaAtMost) {
  const ElasticForce f{.force = 10.0, .stiffness = 1e6, .energy_slope = 10.0};
  for (const double rate : {-1e3, -1e-9, 0.0, 1e-300, 1e-9, 1e3}) {
    for (const double energy : {0.0, 1e-12, 1.0}) {
      TouchMotion touch{.inverse_mass = 0.1};
      touch.add(f, rate, energy);
      const DampingRate damping = find_damping(2.0, touch);
      EXPECT_LE(std::abs(damping.s * rate), 2.0 * (1.0 + 1e-15));
      const double force = damp(f, rate, damping).force;
      EXPECT_GE(force, 0.0);
      EXPECT_LE(force, 3.0 * f.force * (1.0 + 1e-15));
    }
  }
}

TEST(ContactDamping, AtRestWithoutEnergyIsNone) {
  TouchMotion touch{.inverse_mass = 0.1};
  EXPECT_EQ(find_damping(2.0, touch).s, 0.0);
  touch.add({.force = 10.0}, 0.0, 0.0);
  EXPECT_EQ(find_damping(2.0, touch).s, 0.0);
}

TEST(ContactDamping, FullRestitutionHasNone) {
  TouchMotion touch{.inverse_mass = 0.1};
  touch.add({.force = 10.0}, 1.0, 0.1);
  EXPECT_EQ(find_damping(0.0, touch).s, 0.0);
}

// One point, or as many equal ones of the same motion.
TEST(ContactDamping, DoesNotDependOnIntoHowManyPointsATouchIsDivided) {
  TouchMotion whole{.inverse_mass = 0.1};
  whole.add({.force = 10.0}, -0.3, 0.02);
  TouchMotion parts{.inverse_mass = 0.1};
  for (int i = 0; i < 5; ++i) parts.add({.force = 2.0}, -0.3, 0.004);
  const DampingRate a = find_damping(1.5, whole);
  const DampingRate b = find_damping(1.5, parts);
  EXPECT_NEAR(b.s / a.s, 1.0, 1e-15);
  EXPECT_NEAR(b.by_energy / a.by_energy, 1.0, 1e-14);
  EXPECT_NEAR(b.by_square / a.by_square, 1.0, 1e-14);
}

constexpr DampingRate kConstant{.s = 2.0};

TEST(ContactDamping, TheForceNeverPulls) {
  const ElasticForce f{.force = 10.0, .stiffness = 1e6};
  EXPECT_EQ(damp(f, -0.5, kConstant).force, 0.0);
  EXPECT_TRUE(damp(f, -0.7, kConstant).is_cut);
  EXPECT_EQ(damp(f, -0.7, kConstant).stiffness, 0.0);
  EXPECT_EQ(damp(f, -0.7, kConstant).damping, 0.0);
  EXPECT_NEAR(damp(f, -0.4, kConstant).force, 2.0, 1e-14);
  EXPECT_FALSE(damp(f, -0.4, kConstant).is_cut);
  EXPECT_FALSE(damp({}, -0.7, kConstant).is_cut);
}

// force d' = dV/dt + dissipation, cut or not.
TEST(ContactDamping, WorkIsStoredOrDissipated) {
  const HertzLaw law({.stiffness = 1e9, .residual = 1e-8});
  for (const double rate : {-3.0, -0.6, -0.4, 0.0, 0.2, 5.0}) {
    const HertzLaw::Response r = law.evaluate(1e-5);
    const DampedForce f = damp({r.force, r.stiffness}, rate, kConstant);
    EXPECT_GE(f.dissipation, 0.0);
    EXPECT_NEAR(f.force * rate, r.force * rate + f.dissipation,
                1e-14 * r.force * (1.0 + rate * rate));
  }
}

TEST(ContactDamping, OverAStepWorkIsStoredOrDissipatedToo) {
  const HertzLaw law({.stiffness = 1e9, .residual = 1e-8});
  const double h = 1e-5;
  for (const double d1 : {-1e-6, 0.0, 3e-6, 9e-6, 1.2e-5, 3e-5}) {
    const double d0 = 1e-5;
    const auto step = law.evaluate_over_step(d0, d1);
    const double rate = (d1 - d0) / h;
    const DampedForce f = damp({step.force, step.stiffness}, rate, kConstant);
    const double V0 = law.evaluate(d0).energy();
    const double V1 = law.evaluate(d1).energy();
    EXPECT_NEAR(f.force * (d1 - d0), V1 - V0 + h * f.dissipation,
                1e-14 * (V0 + V1 + h * f.dissipation));
  }
}

// Beside other points that are held.
TEST(ContactDamping, ItsDerivativesAreThoseOfTheForce) {
  const HertzLaw law({.stiffness = 1e9, .residual = 1e-8});
  const double depth = 1e-5;
  for (const double rate : {0.3, -0.02, -0.2}) {
    for (const double others : {0.0, 25.0}) {
      const auto at = [&](double d, double v) {
        const HertzLaw::Response r = law.evaluate(d);
        const ElasticForce elastic{r.force, r.stiffness, r.force};
        TouchMotion touch{.inverse_mass = 300.0};
        touch.add(elastic, v, r.energy());
        if (others > 0.0) touch.add({.force = others}, 0.1, 3e-5);
        return damp(elastic, v, find_damping(1.3, touch));
      };
      const DampedForce f = at(depth, rate);
      ASSERT_FALSE(f.is_cut);
      const double by_depth =
          limber::testing::differentiate(
              [&](double x) { return at(depth * (1.0 + x), rate).force; },
              1e-3) /
          depth;
      const double by_rate =
          limber::testing::differentiate(
              [&](double x) { return at(depth, rate * (1.0 + x)).force; },
              1e-3) /
          rate;
      EXPECT_NEAR(f.stiffness / by_depth, 1.0, 1e-9);
      EXPECT_NEAR(f.damping / by_rate, 1.0, 1e-9);
    }
  }
}

TEST(ContactDamping, NaNGoesThrough) {
  EXPECT_TRUE(std::isnan(damp({kNaN, kNaN}, 1.0, kConstant).force));
  EXPECT_TRUE(std::isnan(damp({1.0, 1.0}, kNaN, kConstant).force));
  TouchMotion touch{.inverse_mass = 0.1};
  touch.add({.force = 10.0}, kNaN, 0.1);
  EXPECT_TRUE(std::isnan(find_damping(1.0, touch).s));
}

}  // namespace
}  // namespace limber::contact::contact_damping_test
