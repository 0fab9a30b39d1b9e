// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/linalg/cholesky.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

#include "limber/common/errors.hpp"

namespace limber::fem::cholesky_test {
namespace {

/// Each unknown is coupled to the first alone: eliminated first, that fills the
/// factor.
SparseMatrix make_arrow(int size) {
  std::vector<Eigen::Triplet<double>> entries{{0, 0, 2.0 * size}};
  for (int i = 1; i < size; ++i) {
    entries.emplace_back(i, 0, 1.0);
    entries.emplace_back(i, i, 2.0);
  }
  SparseMatrix lower(size, size);
  lower.setFromTriplets(entries.begin(), entries.end());
  return lower;
}

std::vector<int> count_up(int size) {
  std::vector<int> order(static_cast<std::size_t>(size));
  std::iota(order.begin(), order.end(), 0);
  return order;
}

// 5000 GB in full.
TEST(SparseCholesky, RefusesAFactorThatExceedsTheMemoryBeforeItFactors) {
  constexpr int kSize = 800'000;
  EXPECT_THROW(SparseCholesky(make_arrow(kSize), count_up(kSize), "matrix"),
               NumericalError);
}

TEST(SparseCholesky, SolvesWithAFactorThatFits) {
  constexpr int kSize = 50;
  const SparseCholesky factor(make_arrow(kSize), count_up(kSize), "matrix");
  const SparseMatrix lower = make_arrow(kSize);
  const MatrixX x = MatrixX::Random(kSize, 2);
  const MatrixX b = lower.selfadjointView<Eigen::Lower>() * x;
  EXPECT_LT((factor.solve(b) - x).norm(), 1e-12 * x.norm());
}

}  // namespace
}  // namespace limber::fem::cholesky_test
