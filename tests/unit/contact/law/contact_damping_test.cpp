// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/law/contact_damping.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "limber/common/errors.hpp"
#include "support/differences.hpp"
#include "unit/contact/law/two_body_impact.hpp"

namespace limber::contact::contact_damping_test {
namespace {

using test::TwoBodyImpact;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

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
      for (const double speed : {1e-3, 4.0}) {
        for (const double mass_B : {0.2, 50.0}) {
          const double mass_A = 0.3;
          const ContactDamping d = find_contact_damping(e, speed);
          EXPECT_EQ(d.restitution, e);
          EXPECT_EQ(d.speed, speed);
          const auto out =
              TwoBodyImpact(law, d.coefficient, mass_A, mass_B).run(speed);
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

// There is no b for 0: it is that of the least restitution, and says so.
TEST(ContactDamping, WithoutRestitutionItIsTheLeastAndSaysSo) {
  for (const double e : {0.0, 1e-9, kLeastRestitution}) {
    const ContactDamping d = find_contact_damping(e, 0.5);
    EXPECT_EQ(d.restitution, kLeastRestitution);
    EXPECT_NEAR(d.coefficient, 1.0 / (kLeastRestitution * 0.5), 1e-9);
  }
  for (const HertzLaw& law : make_laws()) {
    const double b = find_contact_damping(0.0, 0.5).coefficient;
    const auto out = TwoBodyImpact(law, b, 1.0, 2.0).run(0.5);
    const auto elastic = TwoBodyImpact(law, 0.0, 1.0, 2.0).run(0.5);
    EXPECT_NEAR((out.speed_B - out.speed_A) / 0.5, kLeastRestitution, 1e-5);
    EXPECT_LT(out.duration, 7.3 * elastic.duration);
  }
}

TEST(ContactDamping, FullRestitutionNeedsNone) {
  EXPECT_EQ(find_contact_damping(1.0, 0.5).coefficient, 0.0);
}

TEST(ContactDamping, ATouchAtRestIsDampedAsASlowOne) {
  const ContactDamping d = find_contact_damping(0.5, 0.0);
  EXPECT_EQ(d.speed, kLeastTouchSpeed);
  EXPECT_EQ(d.coefficient,
            find_contact_damping(0.5, kLeastTouchSpeed).coefficient);
  EXPECT_TRUE(std::isfinite(d.coefficient));
}

TEST(ContactDamping, TheForceNeverPulls) {
  const ElasticForce f{.force = 10.0, .stiffness = 1e6};
  EXPECT_EQ(damp(f, -0.5, 2.0).force, 0.0);
  EXPECT_TRUE(damp(f, -0.7, 2.0).is_cut);
  EXPECT_EQ(damp(f, -0.7, 2.0).stiffness, 0.0);
  EXPECT_EQ(damp(f, -0.7, 2.0).damping, 0.0);
  EXPECT_NEAR(damp(f, -0.4, 2.0).force, 2.0, 1e-14);
  EXPECT_FALSE(damp(f, -0.4, 2.0).is_cut);
  EXPECT_FALSE(damp({}, -0.7, 2.0).is_cut);
}

// force d' = dV/dt + dissipation, cut or not.
TEST(ContactDamping, WorkIsStoredOrDissipated) {
  const HertzLaw law({.stiffness = 1e9, .residual = 1e-8});
  for (const double rate : {-3.0, -0.6, -0.4, 0.0, 0.2, 5.0}) {
    const HertzLaw::Response r = law.evaluate(1e-5);
    const DampedForce f = damp({r.force, r.stiffness}, rate, 2.0);
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
    const DampedForce f = damp({step.force, step.stiffness}, rate, 2.0);
    const double V0 = law.evaluate(d0).energy();
    const double V1 = law.evaluate(d1).energy();
    EXPECT_NEAR(f.force * (d1 - d0), V1 - V0 + h * f.dissipation,
                1e-14 * (V0 + V1 + h * f.dissipation));
  }
}

TEST(ContactDamping, ItsDerivativesAreThoseOfTheForce) {
  const HertzLaw law({.stiffness = 1e9, .residual = 1e-8});
  const double depth = 1e-5;
  const double rate = 0.3;
  const auto at = [&](double d, double v) {
    const HertzLaw::Response r = law.evaluate(d);
    return damp({r.force, r.stiffness}, v, 2.0);
  };
  const DampedForce f = at(depth, rate);
  const double by_depth =
      limber::testing::differentiate(
          [&](double x) { return at(depth * (1.0 + x), rate).force; }, 1e-3) /
      depth;
  const double by_rate = limber::testing::differentiate(
      [&](double x) { return at(depth, rate + x).force; }, 1e-3);
  EXPECT_NEAR(f.stiffness / by_depth, 1.0, 1e-11);
  EXPECT_NEAR(f.damping / by_rate, 1.0, 1e-11);
}

TEST(ContactDamping, BadValuesAreRefused) {
  for (const double bad : {-0.1, 1.0000001, 2.0, kNaN, kInf}) {
    EXPECT_THROW(static_cast<void>(find_contact_damping(bad, 1.0)), InputError);
  }
  for (const double bad : {-1e-9, kNaN, kInf}) {
    EXPECT_THROW(static_cast<void>(find_contact_damping(0.5, bad)),
                 ContractError);
  }
}

TEST(ContactDamping, NaNGoesThrough) {
  EXPECT_TRUE(std::isnan(damp({kNaN, kNaN}, 1.0, 2.0).force));
  EXPECT_TRUE(std::isnan(damp({1.0, 1.0}, kNaN, 2.0).force));
}

}  // namespace
}  // namespace limber::contact::contact_damping_test
