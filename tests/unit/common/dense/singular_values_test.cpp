// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/dense/singular_values.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace limber::dense::singular_values_test {
namespace {

using Eigen::Index;

// Of full rank: sines whose arguments are products.
MatrixX make_matrix(Index rows, Index columns) {
  MatrixX A(rows, columns);
  for (Index i = 0; i < rows; ++i) {
    for (Index j = 0; j < columns; ++j) {
      A(i, j) = std::sin(1.3 * static_cast<double>((i + 1) * (j + 1)));
    }
  }
  return A;
}

void expect_orthonormal(const MatrixX& Q) {
  EXPECT_LE((Q.transpose() * Q - MatrixX::Identity(Q.cols(), Q.cols())).norm(),
            1e-13 * static_cast<double>(Q.cols()));
}

TEST(SingularValues, MakeTheMatrixAgain) {
  for (const auto& [rows, columns] :
       {std::pair{1, 1}, {3, 3}, {7, 4}, {4, 7}, {30, 30}}) {
    const MatrixX A = make_matrix(rows, columns);
    const SingularForm form = find_singular_form(A);
    MatrixX S = MatrixX::Zero(rows, columns);
    S.diagonal() = form.values;
    EXPECT_LE((form.U * S * form.V.transpose() - A).norm(), 1e-12);
    expect_orthonormal(form.U);
    expect_orthonormal(form.V);
    for (Index i = 1; i < form.values.size(); ++i) {
      EXPECT_GE(form.values[i - 1], form.values[i]);
    }
    const RightSingularForm right = find_right_singular_form(A);
    EXPECT_LE((right.values - form.values).norm(), 1e-12);
    expect_orthonormal(right.V);
    EXPECT_EQ(right.V.rows(), columns);
  }
}

TEST(SingularValues, OfThreeByThreeAgreeWithThoseOfAnySize) {
  const Matrix3 A = make_matrix(3, 3);
  const SingularForm3 form = find_singular_form(A);
  EXPECT_LE(
      (form.U * Matrix3(form.values.asDiagonal()) * form.V.transpose() - A)
          .norm(),
      1e-14);
  EXPECT_LE((form.values - find_singular_form(MatrixX(A)).values).norm(),
            1e-14);
}

TEST(SingularValues, SmallOnesKeepTheirDigitsByJacobiRotations) {
  // Columns of very different length, at an angle of one radian.
  MatrixX A(2, 2);
  A << 1.0, 1e-12 * std::cos(1.0), 0.0, 1e-12 * std::sin(1.0);
  // Their product is the determinant; the largest is 1 to 1e-24.
  EXPECT_NEAR(find_singular_form(A).values[1] / (1e-12 * std::sin(1.0)), 1.0,
              1e-12);
}

TEST(SingularValues, LastColumnsOfVSpanTheNullSpace) {
  MatrixX A = make_matrix(9, 6);
  A.col(5) = A.col(1) - 2.0 * A.col(3);
  A.col(2) = A.col(0) + A.col(4);
  const RightSingularForm form = find_right_singular_form(A);
  EXPECT_GT(form.values[3], 1e-6 * form.values[0]);
  EXPECT_LE((A * form.V.rightCols(2)).norm(), 1e-13 * form.values[0]);
}

}  // namespace
}  // namespace limber::dense::singular_values_test
