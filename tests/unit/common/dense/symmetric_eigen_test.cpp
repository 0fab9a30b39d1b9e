// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/dense/symmetric_eigen.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace limber::dense::symmetric_eigen_test {
namespace {

using Eigen::Index;

// A chain of n unit masses and springs between walls.
MatrixX make_chain(Index n) {
  MatrixX K = 2.0 * MatrixX::Identity(n, n);
  K.diagonal(1).setConstant(-1.0);
  K.diagonal(-1).setConstant(-1.0);
  return K;
}

VectorX find_chain_values(Index n) {
  const VectorX k = VectorX::LinSpaced(n, 1.0, static_cast<double>(n));
  const double angle = std::numbers::pi / static_cast<double>(n + 1);
  return 2.0 - 2.0 * (angle * k).array().cos();
}

TEST(SymmetricEigen, HasTheClosedFormOfAChainAscending) {
  for (const Index n : {1, 2, 7, 60}) {
    const MatrixX K = make_chain(n);
    const Eigenpairs pairs = find_eigenpairs(K);
    EXPECT_LE((pairs.values - find_chain_values(n)).norm(), 1e-13 * n);
    EXPECT_LE((find_eigenvalues(K) - pairs.values).norm(), 1e-13 * n);
    EXPECT_LE(
        (K * pairs.vectors - pairs.vectors * MatrixX(pairs.values.asDiagonal()))
            .norm(),
        1e-13 * n);
    EXPECT_LE(
        (pairs.vectors.transpose() * pairs.vectors - MatrixX::Identity(n, n))
            .norm(),
        1e-13 * n);
  }
}

TEST(SymmetricEigen, OfFixedSizeHasTheSameClosedForm) {
  const Matrix3 K3 = make_chain(3);
  const Matrix6 K6 = make_chain(6);
  const Eigenpairs3 three = find_eigenpairs(K3);
  const Eigenpairs6 six = find_eigenpairs(K6);
  EXPECT_LE((three.values - find_chain_values(3)).norm(), 1e-14);
  EXPECT_LE((six.values - find_chain_values(6)).norm(), 1e-14);
  EXPECT_LE((find_eigenvalues(K3) - three.values).norm(), 1e-14);
  EXPECT_LE((find_eigenvalues(K6) - six.values).norm(), 1e-14);
  EXPECT_LE(
      (K3 * three.vectors - three.vectors * Matrix3(three.values.asDiagonal()))
          .norm(),
      1e-14);
  EXPECT_LE((K6 * six.vectors - six.vectors * Matrix6(six.values.asDiagonal()))
                .norm(),
            1e-14);
}

TEST(SymmetricEigen, ReadsTheLowerTriangleAlone) {
  MatrixX K = make_chain(5);
  const VectorX expected = find_eigenvalues(K);
  K.triangularView<Eigen::StrictlyUpper>().setConstant(1e9);
  EXPECT_EQ(find_eigenvalues(K), expected);
  EXPECT_EQ(find_eigenpairs(K).values, expected);
}

TEST(SymmetricEigen, OfAHermitianMatrixIsReal) {
  // A chain with phases on its springs has the chain's eigenvalues.
  const Index n = 6;
  Eigen::MatrixXcd K = make_chain(n).cast<std::complex<double>>();
  Eigen::VectorXcd phase(n);
  for (Index i = 0; i < n; ++i) {
    phase[i] = std::polar(1.0, 0.7 * static_cast<double>(i * i));
  }
  K = (phase.asDiagonal() * K * phase.conjugate().asDiagonal()).eval();
  EXPECT_LE((find_eigenvalues(K) - find_chain_values(n)).norm(), 1e-14 * n);
}

TEST(SymmetricEigen, OfTwoMatricesIsOrthonormalInTheSecond) {
  const Index n = 9;
  const MatrixX K = make_chain(n);
  VectorX masses = VectorX::LinSpaced(n, 0.5, 4.0);
  const MatrixX M = masses.asDiagonal();
  const Eigenpairs pairs = find_eigenpairs(K, M);
  EXPECT_LE((K * pairs.vectors -
             M * pairs.vectors * MatrixX(pairs.values.asDiagonal()))
                .norm(),
            1e-12);
  EXPECT_LE(
      (pairs.vectors.transpose() * M * pairs.vectors - MatrixX::Identity(n, n))
          .norm(),
      1e-12);
  EXPECT_LE((find_eigenpairs(K, 4.0 * MatrixX::Identity(n, n)).values -
             0.25 * find_chain_values(n))
                .norm(),
            1e-13);
}

TEST(SymmetricEigen, GivesTheSameBitsTwice) {
  const MatrixX K = make_chain(40);
  EXPECT_EQ(find_eigenpairs(K).vectors, find_eigenpairs(K).vectors);
}

TEST(SymmetricEigen, OfNaNIsNaN) {
  MatrixX K = make_chain(4);
  K(2, 1) = std::nan("");
  EXPECT_TRUE(find_eigenvalues(K).hasNaN());
}

}  // namespace
}  // namespace limber::dense::symmetric_eigen_test
