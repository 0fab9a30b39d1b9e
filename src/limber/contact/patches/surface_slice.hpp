// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "limber/contact/patches/surface_facets.hpp"
#include "limber/contact/potential/body_kind.hpp"

namespace limber::contact {

/// The surface within a slice.
struct SurfaceSlice {
  SurfaceSlice(const flexbody::ContactSurface& surface,
               const std::vector<SurfaceFacet>& all,
               const std::vector<bool>& is_exact,
               const flexbody::ContactSlice& slice);

  /// The exact nodes of some of its facets, each once.
  [[nodiscard]] std::vector<Vector3> list_points(
      const std::vector<SurfaceFacet>& some) const;

  std::vector<SurfaceFacet> facets;  ///< with their middles between the planes
  Matrix3X normals;                  ///< of the planes, away from it
  VectorX heights;                   ///< [m]

 private:
  const Matrix3X& x_;
  const std::vector<bool>& is_exact_;
};

/// A body that represents a slice, and the largest distance from its surface.
struct SliceBody {
  PlacedBody body;
  double error = 0.0;  ///< [m]
};

/// The round body that a slice is, if any: a ball; a cylinder with flat ends,
/// or cut across its axis; a capsule, or a piece of one. Its round side goes
/// around all of its axis and its nodes are within 1e-3 of the radius. The bore
/// of a tube within a cylinder counts as error alone.
[[nodiscard]] std::optional<SliceBody> find_round_body(
    const SurfaceSlice& slice);

/// A convex polyhedron about a slice, with planes along the normals of its
/// facets, as far out as it reaches: those of flat faces first, of curved ones
/// up to 96 that are most different. Planes between slices, and behind an open
/// surface, do not press. Hollows are filled, which is an error.
[[nodiscard]] std::optional<SliceBody> find_hull(const SurfaceSlice& slice);

}  // namespace limber::contact
