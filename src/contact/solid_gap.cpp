// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/solid_gap.hpp"

#include <algorithm>
#include <limits>

#include "limber/contact/narrow_phase/nearest_cores.hpp"

namespace limber::contact {
namespace {

// Heights that are equal, of the solid's size [-].
constexpr double kLevel = 1e-9;
// Size of a solid that is apart from what it touches [-].
constexpr double kSmaller = 1.0 - 1e-6;

Pose find_pose(const PlacedSolid& solid, const joints::PairBody& body) {
  return Pose{body.R_WB, body.p_WB} * solid.X_BS;
}

SolidGap make_gap(const NearestOfCores& nearest, double distance) {
  const Vector3 way = nearest.on_B - nearest.on_A;
  if (nearest.overlap || way.isZero(0.0)) return {};
  return {way.normalized(), nearest.on_A, nearest.on_B, distance};
}

// As A, and a half space.
SolidGap find_gap_to_plane(const Pose& plane, const ConvexSolid& solid,
                           const Pose& X) {
  const Vector3 n = plane.R.col(2);
  double lowest = std::numeric_limits<double>::infinity();
  double size = 0.0;
  for (const Vector3& corner : solid.corners()) {
    lowest = std::min(lowest, n.dot(X * corner - plane.p));
    size = std::max(size, corner.norm());
  }
  Vector3 sum = Vector3::Zero();
  double count = 0.0;
  for (const Vector3& corner : solid.corners()) {
    const Vector3 x = X * corner;
    if (n.dot(x - plane.p) > lowest + kLevel * size) continue;
    sum += x;
    count += 1.0;
  }
  const Vector3 on_B = sum / count;
  const double distance = n.dot(on_B - plane.p);
  return {n, on_B - distance * n, on_B, distance};
}

}  // namespace

SolidGap find_gap(const PlacedSolid& A, const PlacedSolid& B,
                  const joints::PairBodies& bodies) {
  const Pose X_A = find_pose(A, bodies.A);
  const Pose X_B = find_pose(B, bodies.B);
  if (!A.solid.is_bounded()) return find_gap_to_plane(X_A, B.solid, X_B);
  if (!B.solid.is_bounded()) {
    const SolidGap gap = find_gap_to_plane(X_B, A.solid, X_A);
    return {-gap.normal_W, gap.on_B, gap.on_A, gap.distance};
  }
  const ConvexCore core_A(A.solid.corners(), X_A);
  const auto nearest = find_nearest(core_A, ConvexCore(B.solid.corners(), X_B));
  if (!nearest.overlap) {
    return make_gap(nearest, (nearest.on_B - nearest.on_A).norm());
  }
  // Where they just touch, the way from A to a slightly smaller B.
  return make_gap(
      find_nearest(core_A, ConvexCore(B.solid.corners(), X_B, kSmaller)), 0.0);
}

}  // namespace limber::contact
