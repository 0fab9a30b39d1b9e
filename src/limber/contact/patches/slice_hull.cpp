// SPDX-License-Identifier: BSD-3-Clause
// The convex polyhedron about a slice of a surface.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "limber/common/index.hpp"
#include "limber/contact/patches/surface_slice.hpp"

namespace limber::contact {
namespace {

constexpr std::size_t kMostPlanes = 96;
constexpr double kSameNormal = 1e-3;  // angle between facets in one plane [rad]
constexpr double kWider = 1.25;   // of the angle, if there are too many planes
constexpr double kMargin = 1e-3;  // of planes behind it, of its size [-]

/// Normals, those with most area first.
std::vector<Vector3> list_normals(const std::vector<SurfaceFacet>& facets,
                                  double turn) {
  const double least = std::cos(turn);
  std::vector<const SurfaceFacet*> order;
  for (const SurfaceFacet& f : facets) order.push_back(&f);
  std::ranges::stable_sort(order, [](const auto* a, const auto* b) {
    return a->area.squaredNorm() > b->area.squaredNorm();
  });
  std::vector<Vector3> normals;
  for (const SurfaceFacet* f : order) {
    const Vector3 n = f->area.normalized();
    const bool is_new = std::ranges::none_of(
        normals, [&](const Vector3& other) { return n.dot(other) > least; });
    if (is_new) normals.push_back(n);
  }
  return normals;
}

double find_reach(const std::vector<Vector3>& points, const Vector3& n) {
  double reach = -std::numeric_limits<double>::infinity();
  for (const Vector3& x : points) reach = std::max(reach, n.dot(x));
  return reach;
}

ConvexSolid::Ball find_bounds(const std::vector<Vector3>& points) {
  Vector3 low = points.front();
  Vector3 high = low;
  for (const Vector3& x : points) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  return {0.5 * (low + high), (1.0 + kMargin) * (high - low).norm()};
}

// How far its corners stand out of all facets, and points that no other slice
// has are within it.
double find_hull_error(const ConvexSolid& solid, const SurfaceSlice& slice,
                       const std::vector<Vector3>& points,
                       const std::vector<Vector3>& normals) {
  double error = 0.0;
  for (const Vector3& n : normals) {
    const double reach = find_reach(points, n);
    error = std::max(error, solid.find_high(n) - reach);
  }
  for (const Vector3& x : points) {
    if (((slice.normals.transpose() * x - slice.heights).array() > 0.0).any()) {
      continue;
    }
    double depth = std::numeric_limits<double>::infinity();
    for (const ConvexSolid::Face& face : solid.faces()) {
      if (face.presses) depth = std::min(depth, face.plane.find_depth(x));
    }
    error = std::max(error, depth);
  }
  return error;
}

}  // namespace

std::optional<SliceBody> find_hull(const SurfaceSlice& slice) {
  if (slice.facets.empty()) return {};
  const std::vector<Vector3> points = slice.list_points(slice.facets);
  constexpr std::size_t kLeast = 4;  // corners of a solid
  if (points.size() < kLeast) return {};
  const ConvexSolid::Ball ball = find_bounds(points);
  const std::vector<Vector3> all = list_normals(slice.facets, kSameNormal);
  std::vector<Vector3> normals = all;
  for (double turn = kSameNormal; normals.size() > kMostPlanes;) {
    turn *= kWider;
    normals = list_normals(slice.facets, turn);
  }
  std::vector<ConvexSolid::Face> faces;
  for (const Vector3& n : normals) {
    faces.push_back({{n, find_reach(points, n)}, true});
  }
  for (Eigen::Index k = 0; k < slice.heights.size(); ++k) {
    faces.push_back({{slice.normals.col(k), slice.heights[k]}, false});
  }
  for (int k = 0; k < 3; ++k) {
    for (const double sign : {-1.0, 1.0}) {
      const Vector3 n = sign * Vector3::Unit(k);
      faces.push_back(
          {{n, find_reach(points, n) + kMargin * ball.radius}, false});
    }
  }
  auto solid = ConvexSolid::make_bounded(faces, ball);
  if (!solid) return {};
  const double error = find_hull_error(*solid, slice, points, all);
  return SliceBody{{std::move(*solid), Pose{}}, error};
}

}  // namespace limber::contact
