// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/dense/general_eigen.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace limber::dense::general_eigen_test {
namespace {

using Complex = std::complex<double>;

// s^2 + 2 zeta omega s + omega^2 = 0 of each oscillator.
MatrixX make_oscillators() {
  MatrixX A = MatrixX::Zero(4, 4);
  A(0, 1) = 1.0;
  A(1, 0) = -9.0;  // 3 rad/s
  A(1, 1) = -0.6;  // 10 %
  A(2, 3) = 1.0;
  A(3, 2) = -25.0;
  A(3, 3) = -26.0;  // overdamped: -1 and -25
  return A;
}

TEST(GeneralEigen, HasTheClosedFormOfDampedOscillators) {
  const GeneralEigenpairs pairs =
      find_general_eigenpairs(make_oscillators(), true);
  const Complex s(-0.3, 3.0 * std::sqrt(1.0 - 0.01));
  int found = 0;
  for (Eigen::Index i = 0; i < 4; ++i) {
    if (pairs.values[i].imag() > 0.0) {
      EXPECT_LE(std::abs(pairs.values[i] - s), 1e-13);
      ASSERT_LT(i + 1, 4);  // its conjugate is the next
      EXPECT_EQ(pairs.values[i + 1], std::conj(pairs.values[i]));
      ++found;
    } else if (pairs.values[i].imag() == 0.0) {
      EXPECT_LE(std::min(std::abs(pairs.values[i] + 1.0),
                         std::abs(pairs.values[i] + 25.0)),
                1e-12);
    }
  }
  EXPECT_EQ(found, 1);
}

TEST(GeneralEigen, VectorsAreOfUnitLengthAndOnlyWhereWanted) {
  const MatrixX A = make_oscillators();
  const GeneralEigenpairs pairs = find_general_eigenpairs(A, true);
  const Eigen::MatrixXcd error =
      A.cast<Complex>() * pairs.vectors -
      pairs.vectors * Eigen::MatrixXcd(pairs.values.asDiagonal());
  EXPECT_LE(error.norm(), 1e-12);
  for (int i = 0; i < 4; ++i)
    EXPECT_NEAR(pairs.vectors.col(i).norm(), 1, 1e-14);
  EXPECT_EQ(find_general_eigenpairs(A, false).vectors.size(), 0);
}

TEST(GeneralEigen, SchurFormIsUnitaryAndUpperTriangular) {
  const Eigen::MatrixXcd A = make_oscillators().cast<Complex>();
  const auto schur = find_complex_schur(A);
  ASSERT_TRUE(schur);
  EXPECT_LE((schur->U * schur->T * schur->U.adjoint() - A).norm(), 1e-12);
  EXPECT_LE(
      (schur->U.adjoint() * schur->U - Eigen::MatrixXcd::Identity(4, 4)).norm(),
      1e-14);
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < i; ++j) EXPECT_EQ(schur->T(i, j), 0.0);
  }
}

}  // namespace
}  // namespace limber::dense::general_eigen_test
