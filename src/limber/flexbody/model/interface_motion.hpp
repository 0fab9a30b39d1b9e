// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/common/types.hpp"

namespace limber::flexbody {

/// A^+ of the axes about which a set defines a rotation.
/// @param axes orthonormal, 3 x 0, 3 x 2 or 3 x 3 @param A 3 x 3
[[nodiscard]] Matrix3 invert_second_moment(const Matrix3& A,
                                           const Matrix3X& axes);

/// The mean motion of a weighted node set, as a linear map of its nodes'
/// displacements.
///
/// Equation   p = sum w_i x_i, d_i = x_i - p;
///            u = sum w_i u_i,  theta = A^+ sum y_i x u_i,
///            A = sum (y_i.d_i I - d_i y_i^T)
/// Source     least squares of u + theta x d against the displacement: over a
///            region with w_i = int N_i dA / A, y_i = int N_i d dA / A (so that
///            forces are an even, moments a linear traction on it); over nodes
///            with y_i = w_i d_i
/// Limits     small rotation; on a line of nodes the rotation about it, and at
///            a point every rotation, is undefined and set to zero.
class InterfaceMotion {
 public:
  /// @param nodes node indices @param weights w, sum to one
  /// @param moments y, 3 x n, sum to zero [m]
  /// @param x 3 x N node positions [m] @param body_size largest edge of the
  /// body [m], relative to which a set counts as a point
  InterfaceMotion(std::vector<int> nodes, const VectorX& weights,
                  const Matrix3X& moments, const Matrix3X& x, double body_size);

  /// The motion of one node with rotations of its own.
  /// @param node its index @param rotation index of the three rows that are its
  /// rotation vector @param p its position [m]
  /// @param axes about which it can rotate, orthonormal, 3 x 0, 2 or 3
  /// @param count of nodes and such triples in fields
  [[nodiscard]] static InterfaceMotion of_frame(int node, int rotation,
                                                const Vector3& p,
                                                const Matrix3X& axes,
                                                Eigen::Index count);

  [[nodiscard]] const Vector3& mean_point() const { return p_; }  ///< [m]
  [[nodiscard]] int rotation_rank() const { return rank_; }       ///< 0, 2 or 3
  /// Orthonormal axes about which rotation is defined, 3 x rank.
  [[nodiscard]] const Matrix3X& rotation_axes() const { return axes_; }

  /// Translation and rotation (6 x k) of nodal fields (3N x k).
  [[nodiscard]] Matrix6X apply(const MatrixX& fields) const;

  /// Nodal forces (3N x k) of forces and moments at the mean point (6 x k):
  /// the transpose of `apply`, so that work balances.
  [[nodiscard]] MatrixX spread(const Matrix6X& wrenches) const;

 private:
  InterfaceMotion() = default;

  std::vector<int> nodes_;
  Matrix6X map_;  // 6 x 3 n
  Eigen::Index dofs_ = 0;
  Vector3 p_ = Vector3::Zero();
  Matrix3X axes_;
  int rank_ = 0;
};

}  // namespace limber::flexbody
