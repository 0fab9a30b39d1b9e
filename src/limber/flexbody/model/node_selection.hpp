// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <variant>

#include "limber/common/types.hpp"

/// Ways to select nodes of a mesh, before any mesh is read. Lengths in metres,
/// mesh frame.
namespace limber::flexbody {

/// Nodes of a named physical group.
struct GroupNodes {
  std::string group;

  bool operator==(const GroupNodes&) const = default;
};
/// One node by its Gmsh tag.
struct TaggedNode {
  std::size_t tag = 0;  ///< Gmsh node tag

  bool operator==(const TaggedNode&) const = default;
};
/// The node nearest to a point.
struct NearestNode {
  Vector3 point = Vector3::Zero();  ///< [m]

  bool operator==(const NearestNode&) const = default;
};
/// Nodes on the body's surface inside an axis-aligned box, bounds included.
struct BoxNodes {
  Vector3 lower = Vector3::Zero();  ///< [m]
  Vector3 upper = Vector3::Zero();  ///< [m]

  bool operator==(const BoxNodes&) const = default;
};
/// Nodes on the body's surface near a plane.
struct PlaneNodes {
  Vector3 point = Vector3::Zero();    ///< of the plane [m]
  Vector3 normal = Vector3::UnitZ();  ///< unit vector [-]
  /// Largest distance from the plane [m]; 0: kNearness of the body's longest
  /// edge.
  double tolerance = 0.0;

  bool operator==(const PlaneNodes&) const = default;
};
/// Nodes on the body's surface in or on a filled cylinder, its two end faces
/// included; with an inner radius, those of a tube. Bounds are widened by
/// kNearness of the body's longest edge, so that a wall of exactly this radius
/// is included.
struct CylinderNodes {
  Vector3 from = Vector3::Zero();  ///< one end of the axis [m]
  Vector3 to = Vector3::UnitZ();   ///< the other end [m]
  double radius = 0.0;             ///< [m]
  double inner_radius = 0.0;       ///< [m]

  bool operator==(const CylinderNodes&) const = default;
};
using NodeSelection = std::variant<GroupNodes, TaggedNode, NearestNode,
                                   BoxNodes, PlaneNodes, CylinderNodes>;

/// Fraction of the body's longest edge within which a node is on a plane or on
/// a cylinder's wall [-].
inline constexpr double kNearness = 1e-6;

/// @param point of the plane [m]
/// @param normal of any length except zero [-]
/// @param tolerance [m]; 0: the default
/// @throws InputError for a normal without direction.
[[nodiscard]] PlaneNodes make_plane(const Vector3& point, const Vector3& normal,
                                    double tolerance);
/// @param from, to ends of the axis [m]
/// @param radius, inner_radius [m]
/// @throws InputError for an axis without length or an inner radius above the
/// radius.
[[nodiscard]] CylinderNodes make_cylinder(const Vector3& from,
                                          const Vector3& to, double radius,
                                          double inner_radius);

/// Whether it selects exactly one node of any mesh.
[[nodiscard]] bool is_single_node(const NodeSelection& nodes);

/// Unique name of the selection: "group:tip", "box:0,0,0:1,1,0.5".
[[nodiscard]] std::string name_of(const NodeSelection& nodes);

/// The selection with its numbers, for messages.
[[nodiscard]] std::string describe(const NodeSelection& nodes);

/// Distance of a point from the region, zero in it [m].
[[nodiscard]] double calc_distance(const BoxNodes& box, const Vector3& p_M);
[[nodiscard]] double calc_distance(const PlaneNodes& plane, const Vector3& p_M);
[[nodiscard]] double calc_distance(const CylinderNodes& cylinder,
                                   const Vector3& p_M);

/// Distance up to which a node belongs to the region [m].
/// @param body_size the body's longest edge [m]
[[nodiscard]] double find_tolerance(const BoxNodes& box, double body_size);
[[nodiscard]] double find_tolerance(const PlaneNodes& plane, double body_size);
[[nodiscard]] double find_tolerance(const CylinderNodes& cylinder,
                                    double body_size);

}  // namespace limber::flexbody
