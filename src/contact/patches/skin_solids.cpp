// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/patches/skin_solids.hpp"

#include <algorithm>
#include <optional>
#include <utility>

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

}  // namespace

SkinSolids split_skin(const flexbody::ContactSurface& surface) {
  SkinSolids out;
  if (surface.slices.empty()) return out;
  for (const ConvexSolid& solid : split_mesh(surface.x_B, surface.faces)) {
    for (std::size_t i = 0; i < surface.slices.size(); ++i) {
      auto part = cut_out(solid, surface.slices[i]);
      if (!part) continue;
      out.solids.push_back(std::move(*part));
      out.slices.push_back(i);
    }
    if (out.solids.size() > kMostSkinSolids) return {};
  }
  return out;
}

}  // namespace limber::contact
