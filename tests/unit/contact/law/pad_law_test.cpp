// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/law/pad_law.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "limber/common/dense/linear_solve.hpp"
#include "limber/common/errors.hpp"

/// Pads against all sets of them that could be pressed, and against the rigid
/// punch.
namespace limber::contact::pad_law_test {
namespace {

MatrixX draw_compliance(int k, std::mt19937& random) {
  std::normal_distribution<double> normal;
  MatrixX A(k, k);
  for (double& value : A.reshaped()) value = normal(random);
  return A * A.transpose() + 0.02 * MatrixX::Identity(k, k);
}

VectorX draw_depths(int k, std::mt19937& random) {
  std::normal_distribution<double> normal;
  VectorX d(k);
  for (double& value : d) value = normal(random);
  return d;
}

/// Of all sets of pressed pads the one whose forces push and whose other pads
/// are clear of the plane.
VectorX try_all_sets(const MatrixX& C, const VectorX& d) {
  const auto k = static_cast<int>(d.size());
  for (unsigned set = 0; set < 1U << k; ++set) {
    std::vector<int> on;
    for (int i = 0; i < k; ++i) {
      if ((set >> i & 1U) != 0) on.push_back(i);
    }
    VectorX f = VectorX::Zero(k);
    if (!on.empty()) {
      const VectorX pressed = dense::solve(MatrixX(C(on, on)), VectorX(d(on)));
      f(on) = pressed;
    }
    const VectorX gap = C * f - d;
    const double round_off = 1e-10 * (1.0 + d.norm());
    if (f.minCoeff() >= -round_off && gap.minCoeff() >= -round_off) return f;
  }
  return VectorX::Constant(k, std::nan(""));
}

TEST(PadLaw, PressesThePadsThatASearchOfAllSetsFinds) {
  std::mt19937 random(1);
  for (int i = 0; i < 300; ++i) {
    const int k = 1 + i % 7;
    const MatrixX C = draw_compliance(k, random);
    const VectorX d = draw_depths(k, random);
    PadLaw::Response response;
    PadLaw(C).evaluate(d, response);
    const VectorX expected = try_all_sets(C, d);
    EXPECT_LE((response.force - expected).norm(),
              1e-8 * (1.0 + expected.norm()))
        << "of " << k << " pads, drawing " << i;
  }
}

TEST(PadLaw, IsTheGradientOfItsEnergy) {
  std::mt19937 random(2);
  for (int i = 0; i < 50; ++i) {
    const int k = 25;
    const PadLaw law(draw_compliance(k, random));
    const PadLaw::Vector d = draw_depths(k, random);
    const PadLaw::Vector way = draw_depths(k, random);
    constexpr double kStep = 1e-5;
    PadLaw::Response at;
    PadLaw::Response ahead;
    PadLaw::Response behind;
    law.evaluate(d, at);
    law.evaluate(d + kStep * way, ahead);
    law.evaluate(d - kStep * way, behind);
    const double scale = at.force.norm() * way.norm();
    EXPECT_NEAR((ahead.energy - behind.energy) / (2.0 * kStep),
                at.force.dot(way), 1e-4 * scale);
  }
}

TEST(PadLaw, TellsHowItsForcesFollowTheDepths) {
  std::mt19937 random(3);
  const int k = 9;
  const PadLaw law(draw_compliance(k, random));
  const PadLaw::Vector d = draw_depths(k, random);
  PadLaw::Response at;
  law.evaluate(d, at);
  for (int j = 0; j < k; ++j) {
    PadLaw::Response ahead;
    PadLaw::Vector moved = d;
    moved[j] += 1e-7;
    law.evaluate(moved, ahead);
    EXPECT_LE(((ahead.force - at.force) / 1e-7 - at.stiffness.col(j)).norm(),
              1e-4 * at.stiffness.norm());
  }
}

TEST(PadLaw, ExertsNothingApartAndPassesOnWhatIsNotANumber) {
  std::mt19937 random(4);
  const PadLaw law(draw_compliance(4, random));
  PadLaw::Response response;
  law.evaluate(PadLaw::Vector::Constant(4, -1.0), response);
  EXPECT_EQ(response.force.norm(), 0.0);
  EXPECT_EQ(response.energy, 0.0);
  law.evaluate(PadLaw::Vector::Constant(4, std::nan("")), response);
  EXPECT_TRUE(response.force.hasNaN());
}

TEST(PadLaw, TakesWhatIsAddedToItsFlexibility) {
  std::mt19937 random(4);
  for (int k = 1; k < 7; ++k) {
    const MatrixX C = draw_compliance(k, random);
    const MatrixX added = draw_compliance(k, random);
    const VectorX d = draw_depths(k, random);
    PadLaw::Response response;
    PadLaw(C).evaluate(d, added, response);
    const VectorX f = try_all_sets(C + added, d);
    EXPECT_LT((response.force - f).norm(), 1e-9 * (1.0 + f.norm()));
    EXPECT_NEAR(response.energy, 0.5 * f.dot((C + added) * f),
                1e-9 * (1.0 + response.energy));
  }
}

TEST(PadLaw, CountsWhatIsCommonInItsStiffness) {
  std::mt19937 random(5);
  const MatrixX C = draw_compliance(4, random);
  const MatrixX whole = C + MatrixX::Constant(4, 4, 0.7);
  EXPECT_NEAR(PadLaw(C, 0.7).total_stiffness(), PadLaw(whole).total_stiffness(),
              1e-9);
}

TEST(PadLaw, RefusesFlexibilitiesThatAreNone) {
  EXPECT_THROW(PadLaw(MatrixX::Zero(3, 3)), InputError);
  EXPECT_THROW(PadLaw(-MatrixX::Identity(3, 3)), InputError);
  EXPECT_THROW(PadLaw(MatrixX::Zero(0, 0)), InputError);
  EXPECT_THROW(PadLaw(MatrixX::Identity(26, 26)), InputError);
  EXPECT_THROW(PadLaw(MatrixX::Identity(3, 2)), InputError);
  EXPECT_THROW(PadLaw(MatrixX::Constant(2, 2, std::nan(""))), InputError);
}

// A rigid punch of area A: F = 1.012 * 2 E' sqrt(A / pi) d of a square one
// [@pharr1992]; uniform pressure on 25 pads errs by the pressure at its rim.
TEST(PadLaw, MakesAHalfSpaceAsStiffAsUnderASquarePunch) {
  constexpr double kSide = 0.02;
  constexpr double kModulus = 2e11;
  Matrix3X places(3, 25);
  for (int i = 0; i < 25; ++i) {
    const int row = i / 5;
    places.col(i) << (i % 5 - 2) * kSide / 5, (row - 2) * kSide / 5, 0.0;
  }
  const VectorX area = VectorX::Constant(25, kSide * kSide / 25);
  const PadLaw law(calc_half_space_compliance(places, area, kModulus));
  const double expected =
      1.012 * 2.0 * kModulus * kSide / std::sqrt(std::numbers::pi);
  EXPECT_NEAR(law.total_stiffness(), expected, 0.04 * expected);
}

}  // namespace
}  // namespace limber::contact::pad_law_test
