// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>
#include <vector>

#include "limber/joints/joint.hpp"

namespace limber::joints {

/// The joint kinds of URDF and two more, by their free directions.
enum class JointKind {
  fixed,       ///< no free direction
  revolute,    ///< a hinge: rotation about the axis
  continuous,  ///< the same, without limits
  prismatic,   ///< a slider: translation along the axis
  planar,      ///< translation normal to the axis, rotation about it
  floating,    ///< all directions free
  universal,   ///< rotations about the axis and a second one, normal to it
  ball,        ///< every rotation
};

/// "fixed", "revolute", ...
[[nodiscard]] std::string_view to_string(JointKind kind);

/// Whether the kind's free directions depend on an axis.
[[nodiscard]] bool needs_axis(JointKind kind);

/// Stiffness and damping of a joint's constrained directions, and damping of
/// its free ones.
struct JointParameters {
  double translational_stiffness = 0.0;  ///< [N/m]
  double rotational_stiffness = 0.0;     ///< [N m/rad]
  double translational_damping = 0.0;    ///< [N s/m]
  double rotational_damping = 0.0;       ///< [N m s/rad]
  double free_damping = 0.0;             ///< viscous, in the free directions
                                         ///< [N s/m or N m s/rad]
  /// Whether constrained directions do not deflect. Their stiffness, > 0, then
  /// counts only where an ideal joint is replaced by a stiff one.
  bool is_ideal = false;
};

/// Two directions that complete the unit vector `axis` to a right-handed triad
/// (x, y, axis): the x and y axes if `axis` is z. A planar joint slides along
/// them.
struct PlaneAxes {
  Vector3 x;  ///< unit [-]
  Vector3 y;  ///< unit [-]
};
[[nodiscard]] PlaneAxes find_plane_axes(const Vector3& axis);

/// Free coordinates of a joint. Revolute, continuous: an angle about the axis;
/// prismatic: a distance along it; planar: distances along x and y of
/// find_plane_axes, then an angle about the axis; universal: angles about the
/// axis and the second axis; ball: angles about x, y, z; else none.
[[nodiscard]] std::vector<AxisCoordinate> find_coordinates(
    JointKind kind, const Vector3& axis_F, const Vector3& second_F);

/// A joint with scalar laws along its coordinates. Axes may have any length;
/// axes that the kind does not need are ignored.
/// @throws InputError if an axis has no direction, the axes of a universal
/// joint are not normal to each other, or a value is negative or not finite.
/// @throws ContractError as Joint does.
[[nodiscard]] Joint make_joint(JointKind kind, const Vector3& axis_F,
                               const Vector3& second_F,
                               const JointParameters& parameters,
                               std::vector<JointElement> elements = {});

/// The bushing of any joint but a universal one: stiffness and damping in its
/// constrained directions, `free_damping` in the others.
/// @throws InputError like make_joint.
/// @throws ContractError for a universal joint.
[[nodiscard]] Bushing make_joint_bushing(JointKind kind, const Vector3& axis_F,
                                         const JointParameters& parameters);

}  // namespace limber::joints
