// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/dense/qr.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace limber::dense::qr_test {
namespace {

using Eigen::Index;

MatrixX make_columns(Index rows, Index columns) {
  MatrixX A(rows, columns);
  for (Index i = 0; i < rows; ++i) {
    for (Index j = 0; j < columns; ++j) {
      A(i, j) = std::cos(static_cast<double>((i + 1) * (j + 1)));
    }
  }
  return A;
}

TEST(Qr, QTimesRIsTheMatrix) {
  const MatrixX A = make_columns(7, 4);
  const MatrixX Q = find_q(A, 7);
  const MatrixX R = find_r(A);
  EXPECT_EQ(R.rows(), 4);
  EXPECT_LE((Q.leftCols(4) * R - A).norm(), 1e-14);
  EXPECT_LE((Q.transpose() * Q - MatrixX::Identity(7, 7)).norm(), 1e-14);
  EXPECT_EQ(find_q(A, 4), Q.leftCols(4));
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < i; ++j) EXPECT_EQ(R(i, j), 0.0);
  }
}

TEST(Qr, FurtherColumnsOfQAreNormalToTheMatrix) {
  const MatrixX A = make_columns(8, 3);
  EXPECT_LE((A.transpose() * find_q(A, 8).rightCols(5)).norm(), 1e-14);
}

TEST(Qr, PivotsTellTheRankOfDependentColumns) {
  MatrixX A = make_columns(6, 5);
  A.col(4) = 2.0 * A.col(0) - A.col(2);
  const PivotedQ found = find_pivoted_q(A, 1e-10);
  EXPECT_EQ(found.rank, 4);
  const MatrixX Q = found.Q.leftCols(4);
  EXPECT_LE((A - Q * (Q.transpose() * A)).norm(), 1e-13);
  EXPECT_EQ(find_pivoted_q(MatrixX::Zero(3, 2), 1e-10).rank, 0);
  A.col(4) += 1e-6 * Eigen::VectorXd::Unit(6, 5);
  EXPECT_EQ(find_pivoted_q(A, 1e-10).rank, 5);
  EXPECT_EQ(find_pivoted_q(A, 1e-3).rank, 4);
}

TEST(Qr, LeastSquaresLeaveARemainderNormalToTheColumns) {
  const MatrixX A = make_columns(9, 4);
  const MatrixX b = make_columns(9, 2).array().square();
  const LeastSquares found = solve_least_squares(A, b, 1e-10);
  EXPECT_EQ(found.rank, 4);
  EXPECT_GT((A * found.x - b).norm(), 0.1);
  EXPECT_LE((A.transpose() * (A * found.x - b)).norm(), 1e-13);
  EXPECT_LE((solve_least_squares(A, b) - found.x).norm(), 1e-13);
}

TEST(Qr, LeastSquaresOfDependentColumnsAreFinite) {
  MatrixX A = make_columns(6, 3);
  A.col(2) = A.col(0);
  const MatrixX b = make_columns(6, 1).array().square();
  const LeastSquares found = solve_least_squares(A, b, 1e-10);
  EXPECT_EQ(found.rank, 2);
  EXPECT_TRUE(found.x(0, 0) == 0.0 || found.x(2, 0) == 0.0);
  EXPECT_LE((A.transpose() * (A * found.x - b)).norm(), 1e-13);
}

}  // namespace
}  // namespace limber::dense::qr_test
