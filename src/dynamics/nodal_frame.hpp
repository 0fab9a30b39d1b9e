// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "common/pose.hpp"
#include "flexbody/full_body.hpp"

namespace limber::dynamics {

/// A frame on weighted nodes of an unreduced body, for motion of any size.
///
/// Equation   p = sum_i w_i p_i,  R = argmin sum_i w_i |p_i - p - R d_i|^2
/// Source     weighted orthogonal Procrustes problem [@umeyama1991];
///            for small motion this is flexbody::InterfaceMotion
/// Limits     nodes on one line, or a single one, define no rotation: the
///            frame then turns with its body and takes no moment
struct NodalFrame {
  std::vector<int> nodes;
  VectorX weights;                   ///< sum to one
  Matrix3X d_B;                      ///< 3 x n, undeformed, from the mean [m]
  Vector3 mean_B = Vector3::Zero();  ///< undeformed [m]
  Vector3 arm_B = Vector3::Zero();   ///< from the mean to the origin [m]
  bool turns = false;                ///< the nodes define a rotation
};

/// @param origin_B undeformed origin of the frame, body frame [m]
[[nodiscard]] NodalFrame make_nodal_frame(const flexbody::FullBody& body,
                                          const flexbody::NodeSet& set,
                                          const Vector3& origin_B);

/// Its motion in the home frame H (SystemState::X_WH).
struct NodalFrameMotion {
  Matrix3 R_HB = Matrix3::Identity();  ///< undeformed axes to H
  Vector3 arm_H = Vector3::Zero();     ///< from the mean to the origin [m]
  Vector3 p_H = Vector3::Zero();       ///< of the origin [m]
  Vector3 v_H = Vector3::Zero();       ///< of the origin [m/s]
  Vector3 w_H = Vector3::Zero();       ///< [rad/s]
  /// A moment [N m] to the factor of its nodal forces; zero if it does not
  /// turn [1/m^2].
  Matrix3 spread = Matrix3::Zero();
};

using ConstNodes = Eigen::Map<const Matrix3X>;
using Nodes = Eigen::Map<Matrix3X>;

/// @param u_H, udot_H 3 x N displacement [m] and velocity [m/s]
/// @param R_HB, w_H the body's own, for a frame that does not turn by itself
void calc_nodal_frame(const NodalFrame& frame, const ConstNodes& u_H,
                      const ConstNodes& udot_H, const Matrix3& R_HB,
                      const Vector3& w_H, NodalFrameMotion& motion);

/// Adds the nodal forces of a force [N] and a moment [N m] at the origin, so
/// that work balances and nothing is lost: their sum is the force, and their
/// moment, about any point of H, that of both.
///
/// Equation   f_i = w_i (f + (K^-1 (m + arm x f)) x R d_i),
///            K = tr(S) I - S, S = sum_i w_i R d_i (p_i - p)^T
void add_nodal_wrench(const NodalFrame& frame, const NodalFrameMotion& motion,
                      const Vector3& force_H, const Vector3& moment_H,
                      Eigen::Ref<Matrix3X> force);

/// Rotation R that makes R^T A symmetric and positive: the polar factor of A,
/// of determinant one also where A has rank two.
[[nodiscard]] Matrix3 find_polar_rotation(const Matrix3& A);

}  // namespace limber::dynamics
