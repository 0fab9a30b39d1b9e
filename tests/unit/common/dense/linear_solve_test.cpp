// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/dense/linear_solve.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "limber/common/dense/lu_factors.hpp"

namespace limber::dense::linear_solve_test {
namespace {

using Eigen::Index;
using Complex = std::complex<double>;

// Not symmetric, and with zeros on its diagonal: pivots have to be searched.
MatrixX make_regular(Index n) {
  MatrixX A(n, n);
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < n; ++j) {
      A(i, j) = i == j ? 0.0 : 1.0 / static_cast<double>(1 + i + 2 * j);
    }
  }
  return A;
}

MatrixX make_positive(Index n) {
  const MatrixX A = make_regular(n);
  return A * A.transpose() + MatrixX::Identity(n, n);
}

TEST(LinearSolve, SolutionsSatisfyTheEquations) {
  for (const Index n : {2, 6, 25}) {
    const MatrixX A = make_regular(n);
    const MatrixX B = make_positive(n).leftCols(2);
    const double allowed = 1e-13 * find_inverse(A).norm() * A.norm();
    EXPECT_LE((A * solve(A, B) - B).norm(), allowed);
    EXPECT_LE((A * solve(A, VectorX(B.col(1))) - B.col(1)).norm(), allowed);
    EXPECT_LE((A * find_inverse(A) - MatrixX::Identity(n, n)).norm(), allowed);
    const Eigen::MatrixXcd C = A.cast<Complex>() * Complex(0.6, 0.8);
    EXPECT_LE(
        (C * solve(C, Eigen::MatrixXcd(B.cast<Complex>())) - B.cast<Complex>())
            .norm(),
        allowed);
  }
}

TEST(LinearSolve, OfASingularMatrixIsNotFinite) {
  MatrixX A = MatrixX::Zero(3, 3);
  A(0, 0) = 1.0;
  EXPECT_FALSE(solve(A, MatrixX::Ones(3, 1).eval()).allFinite());
}

TEST(LinearSolve, CholeskyFactorIsLowerAndItsTrianglesAreSolved) {
  const MatrixX A = make_positive(7);
  const auto L = find_cholesky(A);
  ASSERT_TRUE(L);
  EXPECT_LE((*L * L->transpose() - A).norm(), 1e-13 * A.norm());
  EXPECT_TRUE(
      L->triangularView<Eigen::StrictlyUpper>().toDenseMatrix().isZero(0.0));
  const MatrixX B = make_regular(7).leftCols(3);
  EXPECT_LE((*L * solve_lower(*L, B) - B).norm(), 1e-13);
  EXPECT_LE((L->transpose() * solve_lower_transposed(*L, B) - B).norm(), 1e-13);
  MatrixX rows = B.transpose();
  divide_by_lower_transposed(*L, rows);
  EXPECT_LE((rows * L->transpose() - B.transpose()).norm(), 1e-13);
}

TEST(LinearSolve, CholeskyRefusesWhatIsNotPositiveDefinite) {
  MatrixX A = make_positive(4);
  A(2, 2) = -1.0;
  EXPECT_FALSE(find_cholesky(A));
  EXPECT_FALSE(find_cholesky(MatrixX::Zero(2, 2).eval()));
  A(2, 2) = std::nan("");
  EXPECT_FALSE(find_cholesky(A));
}

TEST(LinearSolve, OfComplexTriangles) {
  Eigen::MatrixXcd A = make_positive(5).cast<Complex>();
  A(3, 1) += Complex(0.0, 0.4);
  A(1, 3) = std::conj(A(3, 1));
  const Eigen::MatrixXcd L = find_cholesky(A);
  EXPECT_LE((L * L.adjoint() - A).norm(), 1e-13 * A.norm());
  const Eigen::MatrixXcd B = A.rowwise().reverse();
  EXPECT_LE((L * solve_lower(L, B) - B).norm(), 1e-12);
  const Eigen::MatrixXcd U = L.adjoint();
  const Eigen::VectorXcd b = B.col(0);
  EXPECT_LE((U * solve_upper(U, b) - b).norm(), 1e-12);
}

TEST(LuFactors, SolveColumnsAndRows) {
  const Index n = 8;
  const MatrixX A = make_regular(n);
  LuFactors factors(n);
  VectorX x = VectorX::LinSpaced(n, -1.0, 2.0);
  const VectorX b = x;
  factors.solve(x);
  EXPECT_EQ(x, b);  // of the identity
  ASSERT_TRUE(factors.factor(A));
  factors.solve(x);
  EXPECT_LE((A * x - b).norm(), 1e-12);
  const Matrix6X rows = make_positive(n).topRows<6>();
  Matrix6X result(6, n);
  factors.solve_rows(rows, result);
  EXPECT_LE((result * A.transpose() - rows).norm(), 1e-11);
  EXPECT_LE((A * factors.inverse() - MatrixX::Identity(n, n)).norm(), 1e-12);
}

TEST(LuFactors, TellASingularMatrix) {
  LuFactors factors(3);
  EXPECT_FALSE(factors.factor(MatrixX::Zero(3, 3)));
  MatrixX A = MatrixX::Identity(3, 3);
  EXPECT_TRUE(factors.factor(A));
  A(1, 1) = std::nan("");
  EXPECT_FALSE(factors.factor(A));
}

}  // namespace
}  // namespace limber::dense::linear_solve_test
