// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/common/types.hpp"

namespace limber::dynamics {

/// Nodes of a flexible body in a tree of boxes, to find the node that modes
/// move farthest without evaluating all of them.
///
/// Equation   |Phi_n eta| <= |Phi_c eta| + sum_k r_ck |eta_k|, Phi_c the mean
///            of the rows of a box's nodes, r_ck the largest |Phi_nk - Phi_ck|
/// Source     [@james2004], of spheres in place of nodes
class DisplacementTree {
 public:
  DisplacementTree() = default;
  /// @param x 3 x n undeformed nodes [m] @param Phi 3n x m [kg^-1/2]
  DisplacementTree(const Matrix3X& x, const MatrixX& Phi);

  /// max_n |Phi_n eta| [m], or `least` if that is not exceeded.
  /// @param eta m modal coordinates [kg^1/2 m]
  /// @param leaf a box that is searched first, as the last one was for similar
  /// coordinates, -1: none; set to the one with the node
  [[nodiscard]] double find_largest(const VectorX& eta, double least,
                                    int& leaf) const;

 private:
  struct Found {
    double largest = 0.0;  // [m]
    int leaf = -1;         // with its node
  };
  struct Box {
    int first = 0;  // of its nodes in rows_
    int count = 0;
    int left = -1;  // boxes; -1: a leaf
    int right = -1;
  };
  int add_box(const Matrix3X& x, const MatrixX& Phi, std::vector<int>& nodes,
              int first, int count);
  [[nodiscard]] double find_bound(int box, const VectorX& eta) const;
  void search_leaf(int box, const VectorX& eta, Found& found) const;
  void search(int box, const VectorX& eta, int searched, Found& found) const;

  std::vector<Box> boxes_;
  std::vector<Eigen::Matrix<double, Eigen::Dynamic, 4>> bounds_;  // m x 4
  MatrixX rows_;  // m x 3n, rows of the nodes as the boxes have them
};

}  // namespace limber::dynamics
