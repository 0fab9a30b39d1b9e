// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "limber/common/types.hpp"

/// What a mesh of surfaces and curves does not say of its shells and beams.
namespace limber {

/// Shells: one material, or plies from bottom to top, on a group of surfaces.
struct ShellRegion {
  std::string group;  ///< physical group; empty: all other surfaces
  /// Of each ply, or one for all, > 0 [m].
  std::vector<double> thicknesses;
  /// From axis 1 to each ply's fibre about the normal; empty: one ply [rad].
  std::vector<double> angles = {};
  /// Of each ply the group of its material, or one; empty: that of `group`.
  std::vector<std::string> materials = {};
  /// Material axis 1, by its part in the surface, mesh frame; absent: that of
  /// the lowest ply's material.
  std::optional<Vector3> axis_1 = std::nullopt;
  /// Of the middle of the thickness from the surface, along its normal [m].
  double offset = 0.0;
};

/// Beams: one section on a group of curves.
struct BeamRegion {
  std::string group;    ///< physical group; empty: all other curves
  std::string section;  ///< a name of list_section_shapes()
  std::map<std::string, double> sizes;  ///< by the names of its shape
  /// The section's axis y, by its part across the curve, mesh frame; absent:
  /// any, of a round section.
  std::optional<Vector3> y_axis = std::nullopt;
  Vector3 offset = Vector3::Zero();  ///< of the centroid, mesh frame [m]
};

/// A shape of sections and the names of its sizes.
struct SectionShape {
  std::string name;
  std::vector<std::string> sizes;     ///< required
  std::vector<std::string> optional;  ///< >= 0, 0 if absent
};

/// radius outer, wall of thickness; height along y, width along z; flange: the
/// thickness of walls along z, web: of those along y [m]. "values": area,
/// I_y = int z^2 dA, I_z = int y^2 dA, torsion constant [m^2, m^4], and shear
/// factors (0: no shear flexibility).
[[nodiscard]] const std::vector<SectionShape>& list_section_shapes();

}  // namespace limber
