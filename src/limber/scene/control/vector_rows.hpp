// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/rotation.hpp"
#include "limber/dynamics/system/system_state.hpp"

/// Derivatives of vectors by the states of a linear system: 3 x n each.
namespace limber::scene {

/// Derivatives of a frame's motion and velocity, in the world or another frame.
struct MotionRows {
  Matrix3X p;    ///< position [m]
  Matrix3X phi;  ///< rotation [rad]
  Matrix3X v;    ///< velocity [m/s]
  Matrix3X w;    ///< angular velocity [rad/s]
};

/// The motion of M in F, in F, from their motions in the world: the derivative
/// of dynamics::relate.
[[nodiscard]] inline MotionRows relate(const MotionRows& F, const MotionRows& M,
                                       const dynamics::FrameMotion& at_F,
                                       const dynamics::FrameMotion& at_M) {
  const Matrix3 R_FW = at_F.X_WF.R.transpose();
  const Vector3 p = R_FW * (at_M.X_WF.p - at_F.X_WF.p);
  const Vector3 v = R_FW * (at_M.v_WF_W - at_F.v_WF_W);
  const Vector3 w_F = R_FW * at_F.w_WF_W;
  const Vector3 w_M = R_FW * at_M.w_WF_W;
  const Matrix3X rotation = R_FW * F.phi;
  const Matrix3X w_change = R_FW * F.w + skew(w_F) * rotation;
  MotionRows rows;
  rows.p = R_FW * (M.p - F.p) + skew(p) * rotation;
  rows.phi = R_FW * (M.phi - F.phi);
  rows.v = R_FW * (M.v - F.v) + skew(v) * rotation + skew(p) * w_change -
           skew(w_F) * rows.p;
  rows.w = R_FW * M.w + skew(w_M) * rotation - w_change;
  return rows;
}

/// Derivatives of the rotation vector of R, from those of the rotation of its
/// axes in the outer frame.
[[nodiscard]] inline Matrix3X log_rows(const Matrix3& R, const Matrix3X& phi) {
  return right_jacobian_inverse(-log_rotation(R)) * phi;
}

}  // namespace limber::scene
