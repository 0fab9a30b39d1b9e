// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/dense/exponential.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace limber::dense::exponential_test {
namespace {

constexpr double kRoundOff = 1e-15;

TEST(Exponential, OfZeroIsTheIdentity) {
  Exponential exponential(3);
  EXPECT_EQ(exponential(MatrixX::Zero(3, 3)), MatrixX::Identity(3, 3));
}

TEST(Exponential, OfADiagonalMatrixIsThatOfItsElements) {
  Exponential exponential(3);
  const VectorX rates = Vector3(-1e4, -0.3, 2.0);
  const MatrixX found = exponential(rates.asDiagonal());
  const MatrixX exact = rates.array().exp().matrix().asDiagonal();
  EXPECT_LT((found - exact).cwiseAbs().maxCoeff(), 1e4 * 10 * kRoundOff);
}

TEST(Exponential, OfARotationHasItsAngleFromSmallToManyTurns) {
  Exponential exponential(2);
  for (const double angle : {1e-9, 0.3, 1.0, 3.0, 1e3, 1e5}) {
    MatrixX A(2, 2);
    A << 0.0, angle, -angle, 0.0;
    MatrixX exact(2, 2);
    exact << std::cos(angle), std::sin(angle), -std::sin(angle),
        std::cos(angle);
    EXPECT_LT((exponential(A) - exact).norm(), 10 * kRoundOff * (1.0 + angle))
        << angle;
  }
}

TEST(Exponential, OfANilpotentMatrixIsItsPolynomial) {
  Exponential exponential(3);
  MatrixX A = MatrixX::Zero(3, 3);
  A(0, 1) = 3.0;
  A(1, 2) = 4.0;
  const MatrixX exact = MatrixX::Identity(3, 3) + A + 0.5 * A * A;
  EXPECT_LT((exponential(A) - exact).norm(), 20 * kRoundOff);
}

}  // namespace
}  // namespace limber::dense::exponential_test
