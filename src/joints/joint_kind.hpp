// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>
#include <vector>

#include "joints/joint.hpp"

namespace limber::joints {

/// URDF's joint kinds and two more, each with some directions left free.
enum class JointKind {
  fixed,       ///< nothing free
  revolute,    ///< a hinge: rotation about the axis
  continuous,  ///< the same, without limits
  prismatic,   ///< a slider: translation along the axis
  planar,      ///< translation normal to the axis, rotation about it
  floating,    ///< everything free
  universal,   ///< rotations about the axis and a second one, normal to it
  ball,        ///< every rotation
};

/// "fixed", "revolute", ...
[[nodiscard]] std::string_view to_string(JointKind kind);

/// Whether the kind's free directions follow from an axis.
[[nodiscard]] bool needs_axis(JointKind kind);

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

/// Two directions that make a right-handed triad with the unit vector `axis`: x
/// and y themselves if it is z. Along them a planar joint slides.
struct PlaneAxes {
  Vector3 x;
  Vector3 y;
};
[[nodiscard]] PlaneAxes find_plane_axes(const Vector3& axis);

/// What a joint leaves free: revolute, continuous: an angle about the axis;
/// prismatic: a distance along it; planar: distances along x and y of
/// find_plane_axes, then an angle about the axis; universal: angles about the
/// axis and the second axis; ball: angles about x, y, z; else none.
[[nodiscard]] std::vector<AxisCoordinate> find_coordinates(
    JointKind kind, const Vector3& axis_F, const Vector3& second_F);

/// A joint and what acts along its coordinates. Axes may have any length; those
/// that its kind does not need are not looked at.
/// @throws InputError if an axis has no direction, the axes of a universal
/// joint are not normal to each other, or a value is negative or not finite.
/// @throws ContractError as Joint does.
[[nodiscard]] Joint make_joint(JointKind kind, const Vector3& axis_F,
                               const Vector3& second_F,
                               const JointParameters& parameters,
                               std::vector<JointElement> elements = {});

/// The hold of any joint but a universal one: a bushing with the free
/// directions left out.
/// @throws InputError like make_joint.
/// @throws ContractError for a universal joint.
[[nodiscard]] Bushing make_joint_bushing(JointKind kind, const Vector3& axis_F,
                                         const JointParameters& parameters);

}  // namespace limber::joints
