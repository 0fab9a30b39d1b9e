// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/equations/displacement_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace limber::dynamics::displacement_tree_test {
namespace {

double find_largest_of_all(const MatrixX& Phi, const VectorX& eta) {
  double largest = 0.0;
  for (Eigen::Index n = 0; n < Phi.rows(); n += 3) {
    largest = std::max(largest, (Phi.middleRows<3>(n) * eta).norm());
  }
  return largest;
}

double find_anew(const DisplacementTree& tree, const VectorX& eta,
                 double least) {
  int leaf = -1;
  return tree.find_largest(eta, least, leaf);
}

class DisplacementTreeOf : public ::testing::TestWithParam<int> {
 protected:
  DisplacementTreeOf() {
    const int nodes = GetParam();
    x_ = Matrix3X::NullaryExpr(3, nodes, [this] { return uniform_(random_); });
    Phi_.resize(Eigen::Index{3} * nodes, kModes);
    for (int n = 0; n < nodes; ++n) {
      for (int k = 0; k < kModes; ++k) {
        Phi_(3 * n, k) = std::sin((k + 1) * x_(0, n));
        Phi_(3 * n + 1, k) = std::cos((k + 2) * x_(1, n));
        Phi_(3 * n + 2, k) = x_(2, n) * x_(0, n) / (k + 1);
      }
    }
  }
  [[nodiscard]] VectorX draw() {
    return VectorX::NullaryExpr(kModes, [this] { return uniform_(random_); });
  }

  static constexpr int kModes = 5;
  std::mt19937 random_{7};
  std::uniform_real_distribution<double> uniform_{-1.0, 1.0};
  Matrix3X x_;
  MatrixX Phi_;
};

TEST_P(DisplacementTreeOf, FindsWhatAllNodesGive) {
  const DisplacementTree tree(x_, Phi_);
  for (int i = 0; i < 200; ++i) {
    const VectorX eta = draw();
    const double expected = find_largest_of_all(Phi_, eta);
    EXPECT_NEAR(find_anew(tree, eta, 0.0), expected, 1e-14 * expected);
    EXPECT_NEAR(find_anew(tree, eta, 0.9 * expected), expected,
                1e-14 * expected);
    EXPECT_EQ(find_anew(tree, eta, 1.1 * expected), 1.1 * expected);
  }
}

TEST_P(DisplacementTreeOf, FindsItOfNodesThatMoveAlike) {
  Phi_.rowwise() = Phi_.row(0).eval();
  const DisplacementTree tree(x_, Phi_);
  const VectorX eta = draw();
  const double expected = find_largest_of_all(Phi_, eta);
  EXPECT_NEAR(find_anew(tree, eta, 0.0), expected, 1e-14 * expected);
}

TEST_P(DisplacementTreeOf, FindsTheSameWhereverItSearchesFirst) {
  const DisplacementTree tree(x_, Phi_);
  int leaf = -1;
  for (int i = 0; i < 200; ++i) {
    const VectorX eta = draw();
    const double expected = find_anew(tree, eta, 0.0);
    EXPECT_EQ(tree.find_largest(eta, 0.0, leaf), expected);
    const int found = leaf;
    EXPECT_EQ(tree.find_largest(eta, 0.0, leaf), expected);
    EXPECT_EQ(leaf, found);
    EXPECT_EQ(tree.find_largest(eta, 1.1 * expected, leaf), 1.1 * expected);
    EXPECT_EQ(leaf, found);
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, DisplacementTreeOf,
                         ::testing::Values(1, 8, 9, 100, 3001));

TEST(DisplacementTree, OfNoNodesFindsNothing) {
  EXPECT_EQ(find_anew(DisplacementTree(), VectorX::Ones(3), 0.5), 0.5);
  EXPECT_EQ(find_anew(DisplacementTree(Matrix3X(3, 0), MatrixX(0, 3)),
                      VectorX::Ones(3), 0.5),
            0.5);
}

}  // namespace
}  // namespace limber::dynamics::displacement_tree_test
