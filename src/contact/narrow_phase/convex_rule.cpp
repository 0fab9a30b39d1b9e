// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>

#include "limber/contact/narrow_phase/convex_face.hpp"
#include "limber/contact/narrow_phase/convex_separation.hpp"
#include "limber/contact/narrow_phase/face_overlap.hpp"
#include "limber/contact/narrow_phase/nearest_segments.hpp"
#include "limber/contact/narrow_phase/pair_rules.hpp"

namespace limber::contact {
namespace {

constexpr std::size_t kMostPoints = 4 * ConvexFace::kMostCorners;
// Part of the depth by which corners may be shallower than the deepest point
// before that becomes a feature as well [-].
constexpr double kMissed = 0.1;
// Shares up to this are round-off [-].
constexpr double kFlatSpread = 1e-6;

Segment make_segment(const ConvexFace& face) {
  const Vector3 way = face.corners[1] - face.corners[0];
  const double length = way.norm();
  return {0.5 * (face.corners[0] + face.corners[1]), way / length,
          0.5 * length};
}

// Extent of a face's corners along n [m].
double find_drop(const ConvexFace& face, const Vector3& n) {
  double low = n.dot(face.corners[0]);
  double high = low;
  for (std::size_t i = 1; i < face.count; ++i) {
    low = std::min(low, n.dot(face.corners[i]));
    high = std::max(high, n.dot(face.corners[i]));
  }
  return high - low;
}

// OppositePoints points of both surfaces.
struct OppositePoints {
  Vector3 on_A;
  Vector3 on_B;
};

// The opposite points at the deepest place, separated along n by the depth.
OppositePoints find_deepest_points(const Separation& at,
                                   const ConvexCore& core_A,
                                   const ConvexCore& core_B,
                                   const ConvexFace& A, const ConvexFace& B) {
  const Vector3& n = at.normal_W;
  if (at.is_apart) {
    return {at.on_A + core_A.ball() * n, at.on_B - core_B.ball() * n};
  }
  Vector3 middle;
  if (A.count == 1) {
    middle = A.corners[0] - 0.5 * at.depth * n;
  } else if (B.count == 1) {
    middle = B.corners[0] + 0.5 * at.depth * n;
  } else if (A.count == 2 && B.count == 2) {
    const Segment a = make_segment(A);
    const Segment b = make_segment(B);
    const NearestOfSegments nearest = find_nearest(a, b);
    middle =
        0.5 * (a.centre + nearest.s * a.axis + b.centre + nearest.t * b.axis);
  } else {
    const Vector3 on_A = core_A.find_support_point(n) + core_A.ball() * n;
    const Vector3 on_B = core_B.find_support_point(-n) - core_B.ball() * n;
    // The point of a rim, an edge or a corner, not of the face under it.
    const bool has_line = A.count == 2 || B.count == 2;
    const bool is_on_A =
        has_line ? A.count < B.count : find_drop(A, n) > find_drop(B, n);
    middle = is_on_A ? Vector3(on_A - 0.5 * at.depth * n)
                     : Vector3(on_B + 0.5 * at.depth * n);
  }
  return {middle + 0.5 * at.depth * n, middle - 0.5 * at.depth * n};
}

Meeting make_convex_meeting(const PlacedShape& A, const PlacedShape& B,
                            const Vector3& normal_W,
                            const OppositePoints& points, double curvature) {
  const Vector3 p_W = 0.5 * (points.on_A + points.on_B);
  return {.depth = normal_W.dot(points.on_A - points.on_B),
          .normal_W = normal_W,
          .p_W = p_W,
          .on_A = A.make_place(A.X_WS.inverse() * points.on_A),
          .on_B = B.make_place(B.X_WS.inverse() * points.on_B),
          .curvature = curvature};
}

}  // namespace

std::size_t count_convex_features(const Shape& A, const Shape& B) {
  return count_overlap_points(count_face_corners(A), count_face_corners(B)) + 1;
}

void meet_convex(const PlacedShape& A, const PlacedShape& B,
                 std::span<Meeting> out) {
  const ConvexCore core_A(A);
  const ConvexCore core_B(B);
  const Separation at = find_separation(core_A, core_B);
  const Vector3& n = at.normal_W;
  const ConvexFace face_A = find_face(A, n);
  const ConvexFace face_B = find_face(B, -n);
  const double curvature = face_A.curvature + face_B.curvature;
  std::array<OverlapPoint, kMostPoints> points;
  const auto used = std::span(points).first(out.size() - 1);
  find_overlap(face_A, face_B, n, count_face_corners(A.shape),
               count_face_corners(B.shape), used);
  double deepest = Meeting{}.depth;
  for (std::size_t i = 0; i < used.size(); ++i) {
    out[i] = {};
    if (!(used[i].share > kFlatSpread)) continue;
    out[i] =
        make_convex_meeting(A, B, n, {used[i].on_A, used[i].on_B}, curvature);
    out[i].share = used[i].share;
    deepest = std::max(deepest, out[i].depth);
  }
  Meeting& last = out.back();
  last = {};
  double share = 1.0;
  if (at.depth > 0.0) {
    share = std::clamp((at.depth - deepest) / (kMissed * at.depth), 0.0, 1.0);
  }
  if (!(share > kFlatSpread)) return;
  last = make_convex_meeting(
      A, B, n, find_deepest_points(at, core_A, core_B, face_A, face_B),
      curvature);
  last.depth = at.depth;
  last.share = share;
}

double find_convex_clearance(const PlacedShape& A, const PlacedShape& B) {
  return -find_separation(ConvexCore(A), ConvexCore(B)).depth;
}

}  // namespace limber::contact
