// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "limber/common/types.hpp"
#include "limber/flexbody/model/contact_surface.hpp"

namespace limber::contact {

/// A flat triangle of a surface, four of each face with middle nodes.
struct SurfaceFacet {
  std::array<int, 3> nodes = {};
  Vector3 area = Vector3::Zero();    ///< outward [m^2]
  Vector3 middle = Vector3::Zero();  ///< [m]
  /// Facets that join each other at angles of less than 20 degrees have the
  /// same number.
  int patch = 0;
};

[[nodiscard]] std::vector<SurfaceFacet> find_facets(
    const flexbody::ContactSurface& surface);

/// Whether a surface is closed and of flat faces: where two facets meet, they
/// lie in one plane, within 1e-3, or differ by more than 20 degrees.
[[nodiscard]] bool is_polyhedral(const std::vector<SurfaceFacet>& facets);

/// The nodes that are on the surface itself: of those in the middle of straight
/// edges this is not known.
[[nodiscard]] std::vector<bool> find_exact_nodes(
    const flexbody::ContactSurface& surface);

}  // namespace limber::contact
