// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/potential/polytope.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "limber/common/errors.hpp"

namespace limber::contact {
namespace {

struct Extent {
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();
};

// Of depths below a plane.
Extent find_extent_of(const Polytope& polytope, const Plane& plane) {
  Extent extent;
  for (const Facet& facet : polytope.facets()) {
    for (const Vector3& x : facet.corners()) {
      const double depth = plane.find_depth(x);
      extent.least = std::min(extent.least, depth);
      extent.most = std::max(extent.most, depth);
    }
  }
  return extent;
}

// From the inside, so that both facets of an edge get the same bits and agree
// on which corners are inside of the next plane.
Vector3 cross(const Vector3& inside, double depth, const Vector3& outside,
              double other_depth) {
  return inside + (outside - inside) * (depth / (depth - other_depth));
}

// The part of a facet inside, whose corner where it leaves goes to `rim`.
Facet cut(const Facet& facet, const Plane& plane, Facet& rim) {
  Facet inside(facet.tag());
  const std::span<const Vector3> corners = facet.corners();
  Vector3 last = corners.back();
  double last_depth = plane.find_depth(last);
  for (const Vector3& x : corners) {
    const double depth = plane.find_depth(x);
    if ((depth >= 0.0) != (last_depth >= 0.0)) {
      const Vector3 crossing = depth < 0.0 ? cross(last, last_depth, x, depth)
                                           : cross(x, depth, last, last_depth);
      inside.add(crossing);
      if (depth < 0.0) rim.add(crossing);
    }
    if (depth >= 0.0) inside.add(x);
    last = x;
    last_depth = depth;
  }
  return inside;
}

// The same corners in the order of their angles about their middle.
Facet close(const Facet& rim, const Plane& plane) {
  const std::span<const Vector3> corners = rim.corners();
  Vector3 middle = Vector3::Zero();
  for (const Vector3& x : corners) middle += x;
  middle /= static_cast<double>(corners.size());
  const Vector3 u = plane.n.unitOrthogonal();
  const Vector3 v = plane.n.normalized().cross(u);
  std::array<std::pair<double, Vector3>, Facet::kMost> sorted;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector3 r = corners[i] - middle;
    sorted[i] = {std::atan2(v.dot(r), u.dot(r)), corners[i]};
  }
  const auto end = sorted.begin() + std::ssize(corners);
  std::sort(sorted.begin(), end,
            [](const auto& a, const auto& b) { return a.first < b.first; });
  Facet facet(rim.tag());
  std::for_each(sorted.begin(), end,
                [&](const auto& corner) { facet.add(corner.second); });
  return facet;
}

}  // namespace

void Facet::add(const Vector3& corner) {
  LIMBER_EXPECT(count_ < kMost);
  corners_[count_++] = corner;
}

void Polytope::add(const Facet& facet) {
  LIMBER_EXPECT(count_ < kMost);
  facets_[count_++] = facet;
}

const Polytope& clip(const Polytope& in, const Plane& plane, int tag,
                     Polytope& scratch) {
  const Extent extent = find_extent_of(in, plane);
  if (extent.least >= 0.0) return in;
  scratch.clear();
  if (!(extent.most > 0.0)) return scratch;
  Facet rim(tag);
  for (const Facet& facet : in.facets()) {
    const Facet inside = cut(facet, plane, rim);
    if (inside.corners().size() >= 3) scratch.add(inside);
  }
  if (rim.corners().size() >= 3) scratch.add(close(rim, plane));
  return scratch;
}

}  // namespace limber::contact
