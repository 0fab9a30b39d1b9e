// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/common/pose.hpp"
#include "limber/flexbody/model/full_body.hpp"

namespace limber::dynamics {

/// A frame on weighted nodes of an unreduced body, for motion of any size.
///
/// Equation   p = sum_i w_i p_i,  R = argmin sum_i w_i |p_i - p - R d_i|^2:
///            sum_i y_i x R^T (p_i - p) = 0 with y_i = w_i d_i of nodes, or of
///            a region, where sums over i of its points are integrals, the
///            first moments of flexbody::InterfaceMotion
/// Source     weighted orthogonal Procrustes problem [@umeyama1991];
///            for small motion this is flexbody::InterfaceMotion
///            Nodes on one line along e do not define the rotation about the
///            line: R e = L / |L|, L = sum_i (e . y_i) (p_i - p), and about
///            L it is fitted to the nodes of the whole body, y_i their first
///            moments, which take the moment about the line.
/// Limits     a single node defines no rotation: the frame then rotates with
///            the mean-axis frame of its body, whose nodes take the moment. If
///            the body is clamped it does not rotate, and the clamp takes the
///            moment.
struct NodalFrame {
  std::vector<int> nodes;            ///< indices
  VectorX weights;                   ///< sum to one [-]
  Vector3 mean_B = Vector3::Zero();  ///< undeformed [m]
  Vector3 arm_B = Vector3::Zero();   ///< from the mean to the origin [m]
  bool rotates = false;
  std::vector<int> turning;  ///< indices of the nodes that define the rotation
  Matrix3X d_B;              ///< 3 x n of these, undeformed, from the mean [m]
  /// 3 x n first moments, their sum is zero [m]; with the whole body [kg m].
  Matrix3X y_B;
  VectorX lever;  ///< of nodes on a line: e . y_i [m], their sum is zero
  Vector3 line_B = Vector3::Zero();  ///< L undeformed, along e [m^2]

  [[nodiscard]] bool is_line() const { return lever.size() > 0; }
};

/// @param origin_B undeformed origin of the frame, body frame [m]
[[nodiscard]] NodalFrame make_nodal_frame(const flexbody::FullBody& body,
                                          const flexbody::NodeSet& set,
                                          const Vector3& origin_B);

/// Its motion in the home frame H (SystemState::X_WH).
struct NodalFrameMotion {
  Matrix3 R_HB = Matrix3::Identity();  ///< undeformed axes to H [-]
  Vector3 arm_H = Vector3::Zero();     ///< from the mean to the origin [m]
  Vector3 p_H = Vector3::Zero();       ///< of the origin [m]
  Vector3 v_H = Vector3::Zero();       ///< of the origin [m/s]
  Vector3 w_H = Vector3::Zero();       ///< [rad/s]
  /// Maps a moment [N m] to the factor of its nodal forces: the inverse of the
  /// second moment y_B d_B' [1/m^2, or 1/(kg m^2) with the whole body]; zero if
  /// it does not rotate.
  Matrix3 spread = Matrix3::Zero();
  /// For nodes on a line, maps L' to its part of w_H [1/m^2].
  Matrix3 line_spread = Matrix3::Zero();
};

using ConstNodes = Eigen::Map<const Matrix3X>;
using Nodes = Eigen::Map<Matrix3X>;

/// @param u_H, udot_H 3 x N displacement [m] and velocity [m/s]
void calc_nodal_frame(const NodalFrame& frame, const ConstNodes& u_H,
                      const ConstNodes& udot_H, NodalFrameMotion& motion);

/// Distributes a force [N] and a moment [N m] at the origin to the nodes: the
/// work balances, their sum is the force, and their moment about any point of H
/// that of both.
///
/// Equation   f_i = w_i f + (K^-1 (m + arm x f)) x R y_i,
///            K = tr(S) I - S, S = sum_i R y_i (p_i - p)^T;
///            for nodes on a line along t = L / |L|, with k = K t, K^-1 is t
///            t^T / (k . t), and the line's nodes also take (e . y_i) [(I -
///            t k^T / (k . t)) [t]x / |L|]^T (m + arm x f)
void add_nodal_wrench(const NodalFrame& frame, const NodalFrameMotion& motion,
                      const Vector3& force_H, const Vector3& moment_H,
                      Eigen::Ref<Matrix3X> force);

/// Rotation R that makes R^T A symmetric and positive: the polar factor of A,
/// of determinant one also where A has rank two.
[[nodiscard]] Matrix3 find_polar_rotation(const Matrix3& A);

}  // namespace limber::dynamics
