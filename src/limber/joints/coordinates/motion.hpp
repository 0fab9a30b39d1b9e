// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/types.hpp"

namespace limber::joints {

/// Motion of coupler frame M relative to coupler frame F, expressed in F. The
/// only input of a law, which does not depend on bodies.
struct RelativeMotion {
  Matrix3 R_FM = Matrix3::Identity();  ///< axes of M in F [-]
  Vector3 p_FM_F = Vector3::Zero();    ///< from Fo to Mo [m]
  Vector3 v_FM_F = Vector3::Zero();    ///< its rate as seen in F [m/s]
  Vector3 w_FM_F = Vector3::Zero();    ///< relative angular velocity [rad/s]
};

/// Response of a law. The wrench acts on M at Mo, expressed in F, force first;
/// the opposite force acts on F along the same line. Derivatives are with
/// respect to the increments (dp_FM_F, dphi_F) with
/// dR_FM = skew(dphi_F) R_FM, and to (v_FM_F, w_FM_F).
///
/// Equation   supplied = d energy / dt + dissipation
///                       + wrench . (v_FM_F, w_FM_F)
struct CouplerResponse {
  Vector6 wrench = Vector6::Zero();     ///< [N, N m]
  double energy = 0.0;                  ///< [J]
  double dissipation = 0.0;             ///< power dissipated, >= 0 [W]
  double supplied = 0.0;                ///< power supplied by drives [W]
  Matrix6 stiffness = Matrix6::Zero();  ///< -d wrench / d increment
                                        ///< [N/m, N/rad; N, N m/rad]
  Matrix6 damping = Matrix6::Zero();    ///< -d wrench / d velocity
                                        ///< [N s/m, N s/rad; N s, N m s/rad]
};

/// Stiffness of a joint's constrained directions: that of the stiffest.
struct ConstraintStiffness {
  double translational = 0.0;  ///< kt [N/m]
  double rotational = 0.0;     ///< kr [N m/rad]
};

/// What keeps a joint from its constraint, as a CouplerResponse of unit
/// stiffness in the constrained directions has it.
struct ConstraintGap {
  /// Orthogonal projection of increments and wrenches onto the constrained
  /// directions where the joint does not deflect [-].
  Matrix6 directions = Matrix6::Zero();
  Vector6 gap = Vector6::Zero();  ///< minus the deflection [m, rad]
};

/// Deflection in the constrained directions.
struct ConstraintDeflection {
  double distance = 0.0;  ///< [m]
  double rotation = 0.0;  ///< [rad]
};

}  // namespace limber::joints
