// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/patches/solid_gap.hpp"

#include <algorithm>
#include <limits>

#include "limber/contact/shapes/lowest_point.hpp"
#include "limber/contact/shapes/nearest_cores.hpp"

namespace limber::contact {
namespace {

using joints::PairBody;

// Heights that are equal, of the solid's size, and angles [-].
constexpr double kLevel = 1e-9;
// Size of a solid that is apart from what it touches [-].
constexpr double kSmaller = 1.0 - 1e-6;

bool is_plane(const PatchPart& part) {
  return part.solid() != nullptr && !part.solid()->is_bounded();
}

Pose find_pose(const PatchPart& part, const PairBody& frame) {
  return Pose{frame.R_WB, frame.p_WB} * part.body().X_BS;
}

ConvexCore make_core(const PatchPart& part, const PairBody& frame) {
  if (part.solid() == nullptr) {
    return ConvexCore(PlacedShape(*part.shape(), frame));
  }
  return {part.solid()->corners(), find_pose(part, frame)};
}

SolidGap make_gap(const ConvexCore& A, const ConvexCore& B, bool touches) {
  const NearestOfCores nearest = find_nearest(A, B);
  const Vector3 way = nearest.on_B - nearest.on_A;
  if (nearest.overlap || way.isZero(0.0)) return {};
  const Vector3 n = way.normalized();
  const double distance = way.norm() - A.ball() - B.ball();
  return {n, nearest.on_A + A.ball() * n, nearest.on_B - B.ball() * n,
          touches ? std::min(distance, 0.0) : distance};
}

// The middle of all corners that are as low as the lowest one.
Vector3 find_lowest_corner(const ConvexSolid& solid, const Pose& X,
                           const Vector3& up) {
  double lowest = std::numeric_limits<double>::infinity();
  double size = 0.0;
  for (const Vector3& corner : solid.corners()) {
    lowest = std::min(lowest, up.dot(X.R * corner));
    size = std::max(size, corner.norm());
  }
  Vector3 sum = Vector3::Zero();
  double count = 0.0;
  for (const Vector3& corner : solid.corners()) {
    if (up.dot(X.R * corner) > lowest + kLevel * size) continue;
    sum += corner;
    count += 1.0;
  }
  return X * Vector3(sum / count);
}

// As A, and a half space.
SolidGap find_gap_to_plane(const Pose& plane, const PatchPart& part,
                           const PairBody& frame) {
  const Vector3 n = plane.R.col(2);
  const Vector3 on_B =
      part.solid() != nullptr
          ? find_lowest_corner(*part.solid(), find_pose(part, frame), n)
          : find_lowest_round(PlacedShape(*part.shape(), frame), n, kLevel);
  const double distance = n.dot(on_B - plane.p);
  return {n, on_B - distance * n, on_B, distance};
}

}  // namespace

SolidGap find_gap(const PatchPart& A, const PatchPart& B,
                  const joints::PairBodies& frames) {
  if (is_plane(A)) {
    return find_gap_to_plane(find_pose(A, frames.A), B, frames.B);
  }
  if (is_plane(B)) {
    const SolidGap gap = find_gap_to_plane(find_pose(B, frames.B), A, frames.A);
    return {-gap.normal_W, gap.on_B, gap.on_A, gap.distance};
  }
  const ConvexCore core_A = make_core(A, frames.A);
  ConvexCore core_B = make_core(B, frames.B);
  const SolidGap gap = make_gap(core_A, core_B, false);
  if (!gap.normal_W.isZero(0.0)) return gap;
  // Where they just touch, the way from A to a slightly smaller B.
  core_B.scale(kSmaller);
  return make_gap(core_A, core_B, true);
}

}  // namespace limber::contact
