// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/patches/surface_slice.hpp"

#include <algorithm>

#include "limber/common/index.hpp"

namespace limber::contact {

SurfaceSlice::SurfaceSlice(const flexbody::ContactSurface& surface,
                           const std::vector<SurfaceFacet>& all,
                           const std::vector<bool>& is_exact,
                           const flexbody::ContactSlice& slice)
    : normals(slice.normals_B),
      heights(slice.heights),
      x_(surface.x_B),
      is_exact_(is_exact) {
  const auto is_within = [&](const Vector3& x) {
    return ((normals.transpose() * x - heights).array() <= 0.0).all();
  };
  // Those that pass through a slice thinner than they are.
  const auto reaches = [&](const SurfaceFacet& f) {
    VectorX least = normals.transpose() * f.middle - heights;
    for (const int n : f.nodes) {
      least = least.cwiseMin(normals.transpose() * x_.col(n) - heights);
    }
    return (least.array() <= 0.0).all();
  };
  std::ranges::copy_if(
      all, std::back_inserter(facets),
      [&](const SurfaceFacet& f) { return is_within(f.middle); });
  if (facets.empty()) {
    std::ranges::copy_if(all, std::back_inserter(facets), reaches);
  }
}

std::vector<Vector3> SurfaceSlice::list_points(
    const std::vector<SurfaceFacet>& some) const {
  std::vector<int> nodes;
  for (const SurfaceFacet& f : some) {
    std::ranges::copy_if(f.nodes, std::back_inserter(nodes),
                         [&](int n) { return is_exact_[index(n)]; });
  }
  std::ranges::sort(nodes);
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  std::vector<Vector3> points;
  for (const int n : nodes) points.emplace_back(x_.col(n));
  return points;
}

}  // namespace limber::contact
