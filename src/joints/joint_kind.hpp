// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "joints/bushing.hpp"

namespace limber::joints {

/// URDF's joint kinds, each a bushing with some directions left free.
enum class JointKind {
  fixed,       ///< nothing free
  revolute,    ///< rotation about the axis
  continuous,  ///< the same, without limits
  prismatic,   ///< translation along the axis
  planar,      ///< translation normal to the axis, rotation about it
  floating,    ///< everything free
};

/// Stiffness and damping of the directions that a joint holds, and damping of
/// those that it leaves free.
struct JointParameters {
  double translational_stiffness = 0.0;  ///< [N/m]
  double rotational_stiffness = 0.0;     ///< [N m/rad]
  double translational_damping = 0.0;    ///< [N s/m]
  double rotational_damping = 0.0;       ///< [N m s/rad]
  double free_damping = 0.0;             ///< viscous, in the free directions
                                         ///< [N s/m or N m s/rad]
};

/// Bushing of a joint with unit axis `axis_F`.
/// @throws InputError if the axis has no direction or a value is negative.
[[nodiscard]] Bushing make_joint_bushing(JointKind kind, const Vector3& axis_F,
                                         const JointParameters& parameters);

}  // namespace limber::joints
