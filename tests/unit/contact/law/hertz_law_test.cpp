// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/law/hertz_law.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "limber/common/errors.hpp"
#include "support/differences.hpp"

namespace limber::contact::hertz_law_test {
namespace {

using ::testing::HasSubstr;

constexpr double kEps = std::numeric_limits<double>::epsilon();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

// The depth of a force and the energy stored there, in more digits.
long double find_depth(const HertzLaw& law, long double force) {
  const auto& p = law.parameters();
  const long double flat = p.stiffness == HertzLaw::kRigid
                               ? 0.0L
                               : std::pow(force / p.stiffness, 2.0L / 3.0L);
  return flat + p.residual * force;
}

std::vector<HertzLaw> make_laws() {
  std::vector<HertzLaw> laws;
  for (double k = 1.0; k < 2e15; k *= 1e3) {
    for (const double R : {0.0, 1e-20, 1e-14, 1e-10, 1e-6, 1e-2, 1e3, 1e12}) {
      laws.emplace_back(HertzLaw::Parameters{.stiffness = k, .residual = R});
    }
  }
  for (const double R : {1e-10, 1.0}) {
    laws.emplace_back(
        HertzLaw::Parameters{.stiffness = HertzLaw::kRigid, .residual = R});
  }
  return laws;
}

// Force by depth is no worse conditioned than f ~ d^1.5.
TEST(HertzLaw, TheForceOfADepthIsRightToRoundoffOverTheWholeRange) {
  double worst = 0.0;
  int count = 0;
  for (const HertzLaw& law : make_laws()) {
    for (double depth = 1e-15; depth < 2.0; depth *= 3.7) {
      const HertzLaw::Response r = law.evaluate(depth);
      const long double back = find_depth(law, r.force);
      worst =
          std::max(worst, std::abs(static_cast<double>(back / depth - 1.0L)));
      ++count;
    }
  }
  EXPECT_GT(count, 1000);
  EXPECT_LE(worst, 8.0 * kEps);
}

TEST(HertzLaw, TheDepthOfAForceGivesTheForceBack) {
  std::mt19937_64 generator(7);
  std::uniform_real_distribution<double> exponent(-15.0, 8.0);
  double worst = 0.0;
  for (const HertzLaw& law : make_laws()) {
    for (int i = 0; i < 20; ++i) {
      const double force = std::pow(10.0, exponent(generator));
      const double depth = static_cast<double>(find_depth(law, force));
      worst =
          std::max(worst, std::abs(law.evaluate(depth).force / force - 1.0));
    }
  }
  EXPECT_LE(worst, 16.0 * kEps);
}

TEST(HertzLaw, WithoutResidualItIsHertzs) {
  const HertzLaw law({.stiffness = 4e9});
  for (const double depth : {1e-9, 2e-6, 0.3}) {
    const HertzLaw::Response r = law.evaluate(depth);
    const double force = 4e9 * depth * std::sqrt(depth);
    EXPECT_NEAR(r.force / force, 1.0, 16.0 * kEps);
    EXPECT_NEAR(r.stiffness / (1.5 * force / depth), 1.0, 16.0 * kEps);
    EXPECT_NEAR(r.energy() / (0.4 * force * depth), 1.0, 16.0 * kEps);
    EXPECT_EQ(r.residual_depth, 0.0);
    EXPECT_EQ(r.residual_energy, 0.0);
  }
}

TEST(HertzLaw, BetweenSurfacesThatDoNotFlattenItIsLinear) {
  const HertzLaw law({.stiffness = HertzLaw::kRigid, .residual = 2e-8});
  for (const double depth : {1e-12, 1e-4, 1.0}) {
    const HertzLaw::Response r = law.evaluate(depth);
    EXPECT_NEAR(r.force / (depth / 2e-8), 1.0, 16.0 * kEps);
    EXPECT_NEAR(r.stiffness * 2e-8, 1.0, 4.0 * kEps);
    EXPECT_EQ(r.hertz_depth, 0.0);
    EXPECT_NEAR(r.energy() / (0.5 * depth * depth / 2e-8), 1.0, 32.0 * kEps);
  }
}

TEST(HertzLaw, ItsPartsAddUpToTheDepth) {
  for (const HertzLaw& law : make_laws()) {
    for (const double depth : {1e-14, 1e-6, 0.5}) {
      const HertzLaw::Response r = law.evaluate(depth);
      EXPECT_NEAR((r.hertz_depth + r.residual_depth) / depth, 1.0, 8.0 * kEps);
    }
  }
}

TEST(HertzLaw, NothingActsApart) {
  const HertzLaw law({.stiffness = 1e9, .residual = 1e-9});
  for (const double depth : {0.0, -0.0, -1e-300, -1.0, -kInf}) {
    const HertzLaw::Response r = law.evaluate(depth);
    EXPECT_EQ(r.force, 0.0);
    EXPECT_EQ(r.stiffness, 0.0);
    EXPECT_EQ(r.energy(), 0.0);
  }
}

TEST(HertzLaw, TheForceIsTheEnergysDerivativeAndTheStiffnessTheForces) {
  testing::Margin force;
  testing::Margin stiffness;
  for (const HertzLaw& law : make_laws()) {
    for (const double depth : {1e-9, 1e-5, 0.2}) {
      const HertzLaw::Response r = law.evaluate(depth);
      const auto at = [&](double x) { return law.evaluate(depth * (1.0 + x)); };
      const double dV = testing::differentiate(
                            [&](double x) { return at(x).energy(); }, 1e-3) /
                        depth;
      const double df =
          testing::differentiate([&](double x) { return at(x).force; }, 1e-3) /
          depth;
      force.add(std::abs(dV / r.force - 1.0), 1.0);
      stiffness.add(std::abs(df / r.stiffness - 1.0), 1.0);
    }
  }
  force.expect_below(1e-11);
  stiffness.expect_below(1e-11);
}

TEST(HertzLaw, WhereTheResidualGrowsTheEnergyFallsByHalfTheForceSquared) {
  const double depth = 3e-6;
  const auto energy = [&](double x) {
    return HertzLaw({.stiffness = 5e9, .residual = 2e-9 * (1.0 + x)})
        .evaluate(depth)
        .energy();
  };
  const double force =
      HertzLaw({.stiffness = 5e9, .residual = 2e-9}).evaluate(depth).force;
  const double slope = testing::differentiate(energy, 1e-3) / 2e-9;
  EXPECT_NEAR(slope / (-0.5 * force * force), 1.0, 1e-10);
}

TEST(HertzLaw, AnEnergyGivesTheStateThatStoresIt) {
  double worst = 0.0;
  for (const HertzLaw& law : make_laws()) {
    for (double depth = 1e-14; depth < 2.0; depth *= 11.0) {
      const HertzLaw::Response r = law.evaluate(depth);
      const HertzLaw::Response back = law.find_state_of_energy(r.energy());
      worst = std::max(worst, std::abs(back.force / r.force - 1.0));
    }
  }
  EXPECT_LE(worst, 16.0 * kEps);
  const HertzLaw law({.stiffness = 1.0});
  EXPECT_EQ(law.find_state_of_energy(0.0).force, 0.0);
  EXPECT_THROW(static_cast<void>(law.find_state_of_energy(-1.0)),
               ContractError);
  EXPECT_THROW(static_cast<void>(law.find_state_of_energy(kNaN)),
               ContractError);
}

// Newton's method of the system then tells where it happened.
TEST(HertzLaw, NaNGoesThrough) {
  const HertzLaw law({.stiffness = 1e9, .residual = 1e-9});
  EXPECT_TRUE(std::isnan(law.evaluate(kNaN).force));
  EXPECT_TRUE(std::isnan(law.evaluate(kNaN).energy()));
}

void expect_refused(const HertzLaw::Parameters& p, const std::string& text) {
  try {
    static_cast<void>(HertzLaw(p));
    ADD_FAILURE() << "taken: " << text;
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr(text));
  }
}

TEST(HertzLaw, BadValuesAreRefused) {
  for (const double bad : {0.0, -1.0, kNaN, -kInf}) {
    expect_refused({.stiffness = bad}, "its stiffness [N/m^1.5] is");
  }
  for (const double bad : {kNaN, kInf, -kInf}) {
    expect_refused({.stiffness = 1.0, .residual = bad},
                   "its residual flexibility [m/N] is");
  }
  for (const double bad : {0.0, -1e-9}) {
    expect_refused({.stiffness = HertzLaw::kRigid, .residual = bad},
                   "that do not flatten");
  }
}

}  // namespace
}  // namespace limber::contact::hertz_law_test
