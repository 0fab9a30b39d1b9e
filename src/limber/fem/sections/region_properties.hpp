// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "limber/common/material/section_regions.hpp"
#include "limber/fem/solid/material.hpp"
#include "limber/fem/structural/structure.hpp"

namespace limber::fem {

struct MeshSections {
  std::vector<ShellRegion> shells;
  std::vector<BeamRegion> beams;
  std::vector<MaterialAssignment> materials;  ///< by group, of all elements
};

/// Axis 1 of a region's laminate, of which a cylindrical material has another
/// at each place.
struct LaminateAxis {
  Vector3 constant = Vector3::Zero();  ///< zero: a material without directions
  std::optional<MaterialAxes> cylinder = std::nullopt;

  [[nodiscard]] Vector3 at(const Vector3& x) const {
    return cylinder ? Vector3(cylinder->at(x).col(0)) : constant;
  }
};

/// What a region names, of the material of its group, or of that without group.
/// @throws InputError, without its place, for a missing or unsuited material or
/// sizes that give no section
[[nodiscard]] Laminate find_laminate(const ShellRegion& region,
                                     const MeshSections& sections);
[[nodiscard]] LaminateAxis find_laminate_axis(const ShellRegion& region,
                                              const MeshSections& sections);
[[nodiscard]] BeamProperty find_property(const BeamRegion& region,
                                         const MeshSections& sections);

}  // namespace limber::fem
