// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/newton/block_lu.hpp"

#include <gtest/gtest.h>

#include <random>

#include "limber/common/dense/linear_solve.hpp"
#include "limber/common/errors.hpp"

namespace limber::dynamics::block_lu_test {
namespace {

using Edges = std::vector<std::pair<int, int>>;

Edges chain(int n) {
  Edges edges;
  for (int i = 0; i + 1 < n; ++i) edges.emplace_back(i, i + 1);
  return edges;
}

// Diagonally dominant random matrix on the pattern, solved both ways.
void expect_solves(int n, const Edges& edges) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  BlockLu lu(n, edges);
  MatrixX full = MatrixX::Zero(6 * n, 6 * n);
  lu.set_zero();
  const auto fill = [&](int i, int j) {
    Matrix6& block = lu.block(i, j);
    for (double& x : block.reshaped()) x = uniform(random);
    if (i == j) block.diagonal().array() += 30.0;
    full.block<6, 6>(6 * i, 6 * j) = block;
  };
  for (int i = 0; i < n; ++i) fill(i, i);
  for (const auto& [i, j] : edges) {
    fill(i, j);
    fill(j, i);
  }
  VectorX b(6 * n);
  for (double& x : b) x = uniform(random);
  std::vector<Vector6> x(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) {
    x[static_cast<std::size_t>(i)] = b.segment<6>(6 * i);
  }
  ASSERT_EQ(lu.factor(), std::nullopt);
  lu.solve(x);
  const VectorX expected = dense::solve(full, b);
  for (int i = 0; i < n; ++i) {
    EXPECT_LT(
        (x[static_cast<std::size_t>(i)] - expected.segment<6>(6 * i)).norm(),
        1e-12);
  }
}

TEST(BlockLu, SolvesAChain) { expect_solves(20, chain(20)); }

TEST(BlockLu, SolvesARing) {
  Edges edges = chain(12);
  edges.emplace_back(0, 11);
  expect_solves(12, edges);
}

TEST(BlockLu, SolvesAStarOfArmsOnOneBase) {
  expect_solves(
      9,
      {{0, 3}, {0, 6}, {3, 6}, {0, 1}, {1, 2}, {3, 4}, {4, 5}, {6, 7}, {7, 8}});
}

TEST(BlockLu, SolvesSeparateBlocks) { expect_solves(5, {}); }

TEST(BlockLu, ChainHasNoFill) {
  const BlockLu lu(1000, chain(1000));
  EXPECT_EQ(lu.stored_blocks(), 1000u + 2u * 999u);
}

TEST(BlockLu, SingularPivotIsReported) {
  BlockLu lu(3, {});
  lu.set_zero();
  for (const int row : {0, 2}) lu.block(row, row).setIdentity();
  EXPECT_EQ(lu.factor(), 1);
}

TEST(BlockLu, BlockOutsideThePatternIsACallersDefect) {
  BlockLu lu(3, chain(3));
  EXPECT_THROW(lu.block(0, 2), ContractError);
}

}  // namespace
}  // namespace limber::dynamics::block_lu_test
