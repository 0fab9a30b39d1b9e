// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <variant>

#include "limber/common/types.hpp"

/// Shapes of bodies for contact, as given in robots and scenarios.
namespace limber::scene {

/// All lengths > 0 [m].
struct SphereGeometry {
  double radius = 0.0;
};
struct BoxGeometry {
  Vector3 size = Vector3::Zero();  ///< whole edges, along x, y, z
};
struct CylinderGeometry {
  double radius = 0.0;
  double length = 0.0;  ///< along z, the origin in its middle
};
/// All within `radius` of a segment.
struct CapsuleGeometry {
  double radius = 0.0;
  double length = 0.0;  ///< of the segment, along z, the origin in its middle
};
struct ConeGeometry {
  double radius = 0.0;
  double length = 0.0;  ///< along z to the tip, the origin half way
};
struct EllipsoidGeometry {
  Vector3 radii = Vector3::Zero();  ///< along x, y, z
};
/// z <= 0
struct PlaneGeometry {};
/// A closed surface in a file of triangles.
struct MeshGeometry {
  std::filesystem::path file;
  Vector3 scale = Vector3::Ones();  ///< of its coordinates, none 0 [m]
};
/// A shape that cannot be used: of another program, without size, or a mesh
/// that is not there.
struct OtherGeometry {
  std::string tag;
  std::string reason = {};  ///< with file and line; empty: the tag is unknown
};
using Geometry = std::variant<SphereGeometry, BoxGeometry, CylinderGeometry,
                              CapsuleGeometry, ConeGeometry, EllipsoidGeometry,
                              PlaneGeometry, MeshGeometry, OtherGeometry>;

}  // namespace limber::scene
