// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/patches/surface_parts.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "limber/contact/patches/surface_slice.hpp"
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

// @return whether there are not too many
bool add_solids(const flexbody::ContactSurface& surface, SurfaceParts& out) {
  for (const ConvexSolid& solid : split_mesh(surface.x_B, surface.faces)) {
    for (std::size_t i = 0; i < surface.slices.size(); ++i) {
      auto part = cut_out(solid, surface.slices[i]);
      if (!part) continue;
      out.bodies.push_back({std::move(*part), Pose{}});
      out.slices.push_back(i);
    }
    if (out.bodies.size() > kMostSurfaceParts) return false;
  }
  return !out.bodies.empty();
}

// One of each slice that has facets.
void add_bodies(const flexbody::ContactSurface& surface,
                const std::vector<SurfaceFacet>& facets, SurfaceParts& out) {
  const std::vector<bool> is_exact = find_exact_nodes(surface);
  for (std::size_t i = 0; i < surface.slices.size(); ++i) {
    const SurfaceSlice slice(surface, facets, is_exact, surface.slices[i]);
    auto found = find_round_body(slice);
    if (!found) found = find_hull(slice);
    if (!found) continue;
    out.bodies.push_back(std::move(found->body));
    out.slices.push_back(i);
    out.error = std::max(out.error, found->error);
  }
}

/// Boxes along the axes, of which those whose hulls are farthest from the
/// surface are halved.
class MeshCover {
 public:
  explicit MeshCover(const flexbody::ContactSurface& mesh)
      : mesh_(mesh),
        facets_(find_facets(mesh)),
        is_exact_(find_exact_nodes(mesh)) {}

  SurfaceParts run() {
    constexpr double kClose = 1e-3;  // of the mesh's size
    const Vector3 low = mesh_.x_B.rowwise().minCoeff();
    const Vector3 high = mesh_.x_B.rowwise().maxCoeff();
    flexbody::ContactSlice whole;
    whole.normals_B.resize(3, 0);
    add({low, high, std::move(whole), {}});
    while (!boxes_.empty() && boxes_.size() < kMostSurfaceParts) {
      const auto worst = std::ranges::max_element(
          boxes_, {}, [](const Box& box) { return box.hull->error; });
      if (worst->hull->error <= kClose * (high - low).norm()) break;
      const Box box = *worst;
      boxes_.erase(worst);
      int axis = 0;
      (void)(box.high - box.low).maxCoeff(&axis);
      add(halve(box, axis, 1.0));
      add(halve(box, axis, -1.0));
    }
    SurfaceParts out;
    for (const Box& box : boxes_) {
      out.bodies.push_back(box.hull->body);
      out.error = std::max(out.error, box.hull->error);
    }
    return out;
  }

 private:
  struct Box {
    Vector3 low;
    Vector3 high;
    flexbody::ContactSlice planes;  // to the boxes beside it
    std::optional<SliceBody> hull;
  };

  static Box halve(const Box& box, int axis, double sign) {
    Box half = box;
    const double middle = 0.5 * (box.low[axis] + box.high[axis]);
    (sign > 0.0 ? half.high : half.low)[axis] = middle;
    const Eigen::Index k = box.planes.heights.size();
    half.planes.normals_B.conservativeResize(Eigen::NoChange, k + 1);
    half.planes.heights.conservativeResize(k + 1);
    half.planes.normals_B.col(k) = sign * Vector3::Unit(axis);
    half.planes.heights[k] = sign * middle;
    return half;
  }

  // Unless nothing of the surface is in it.
  void add(Box box) {
    box.hull = find_hull(SurfaceSlice(mesh_, facets_, is_exact_, box.planes));
    if (box.hull) boxes_.push_back(std::move(box));
  }

  const flexbody::ContactSurface& mesh_;
  std::vector<SurfaceFacet> facets_;
  std::vector<bool> is_exact_;
  std::vector<Box> boxes_;
};

}  // namespace

SurfaceParts split_surface(const flexbody::ContactSurface& surface) {
  SurfaceParts out;
  if (surface.slices.empty()) return out;
  const std::vector<SurfaceFacet> facets = find_facets(surface);
  if (is_polyhedral(facets) && add_solids(surface, out)) return out;
  out = {};
  add_bodies(surface, facets, out);
  return out;
}

SurfaceParts cover_mesh(const flexbody::ContactSurface& mesh) {
  return MeshCover(mesh).run();
}

}  // namespace limber::contact
