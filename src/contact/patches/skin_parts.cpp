// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/patches/skin_parts.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "limber/contact/patches/skin_slice.hpp"
#include "limber/contact/potential/mesh_parts.hpp"

namespace limber::contact {
namespace {

using Face = ConvexSolid::Face;

// Volume of a solid that counts as none, of its slice's part [-].
constexpr double kNone = 1e-9;

// Nothing where no face that presses is left.
std::optional<ConvexSolid> cut_out(const ConvexSolid& solid,
                                   const flexbody::ContactSlice& slice) {
  std::vector<Face> faces;
  for (const Face& face : solid.faces()) {
    faces.push_back({face.plane, face.presses});
  }
  for (Eigen::Index k = 0; k < slice.heights.size(); ++k) {
    faces.push_back({{slice.normals_B.col(k), slice.heights[k]}, false});
  }
  if (faces.size() > ConvexSolid::kMostFaces) return {};
  auto part = ConvexSolid::make_bounded(faces, solid.ball());
  if (!part || part->find_volume() <= kNone * solid.find_volume()) return {};
  const bool presses = std::ranges::any_of(
      part->faces(), [](const Face& f) { return f.presses; });
  return presses ? part : std::nullopt;
}

// @return whether there is any
bool add_solids(const flexbody::ContactSurface& surface, SkinParts& out) {
  for (const ConvexSolid& solid : split_mesh(surface.x_B, surface.faces)) {
    for (std::size_t i = 0; i < surface.slices.size(); ++i) {
      auto part = cut_out(solid, surface.slices[i]);
      if (!part) continue;
      out.bodies.push_back({std::move(*part), Pose{}});
      out.slices.push_back(i);
    }
    if (out.bodies.size() > kMostSkinParts) return false;
  }
  return !out.bodies.empty();
}

// @return whether every slice has one
bool add_bodies(const flexbody::ContactSurface& surface,
                const std::vector<SkinFacet>& facets, SkinParts& out) {
  const std::vector<bool> is_exact = find_exact_nodes(surface);
  for (std::size_t i = 0; i < surface.slices.size(); ++i) {
    const SkinSlice slice(surface, facets, is_exact, surface.slices[i]);
    auto found = find_round_body(slice);
    if (!found) found = find_hull(slice);
    if (!found) return false;
    out.bodies.push_back(std::move(found->body));
    out.slices.push_back(i);
    out.error = std::max(out.error, found->error);
  }
  return true;
}

}  // namespace

SkinParts split_skin(const flexbody::ContactSurface& surface) {
  SkinParts out;
  if (surface.slices.empty()) return out;
  const std::vector<SkinFacet> facets = find_facets(surface);
  const bool is_whole = is_polyhedral(facets)
                            ? add_solids(surface, out)
                            : add_bodies(surface, facets, out);
  return is_whole ? out : SkinParts{};
}

}  // namespace limber::contact
