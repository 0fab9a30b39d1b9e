// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/types.hpp"

namespace limber::joints {

/// Motion of coupler frame M relative to coupler frame F, all in F. What a
/// law sees: never a body.
struct RelativeMotion {
  Matrix3 R_FM = Matrix3::Identity();
  Vector3 p_FM_F = Vector3::Zero();  ///< from Fo to Mo [m]
  Vector3 v_FM_F = Vector3::Zero();  ///< its rate as seen in F [m/s]
  Vector3 w_FM_F = Vector3::Zero();  ///< relative angular velocity [rad/s]
};

/// What a law answers. The wrench acts on M at Mo, in F, force first; the
/// opposite force acts on F along the same line. Derivatives are with respect
/// to the increments (dp_FM_F, dphi_F) with dR_FM = skew(dphi_F) R_FM, and to
/// (v_FM_F, w_FM_F).
///
/// Equation   supplied = d energy / dt + dissipation
///                       + wrench . (v_FM_F, w_FM_F)
struct CouplerResponse {
  Vector6 wrench = Vector6::Zero();     ///< [N, N m]
  double energy = 0.0;                  ///< [J]
  double dissipation = 0.0;             ///< power turned to heat, >= 0 [W]
  double supplied = 0.0;                ///< power that drives put in [W]
  Matrix6 stiffness = Matrix6::Zero();  ///< -d wrench / d increment
  Matrix6 damping = Matrix6::Zero();    ///< -d wrench / d velocity
};

}  // namespace limber::joints
