// SPDX-License-Identifier: BSD-3-Clause SkinPairSearch between flat
// faces, which have no unique nearest place: corners, and edges that
// cross.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "limber/common/index.hpp"
#include "limber/contact/narrow_phase/skin_pair_search.hpp"

namespace limber::contact {
namespace {

// Slope beyond a corner or an edge up to which the shallower end of a line
// counts [-].
constexpr double kLeans = 0.3;
// Smallest cosine between the normal of two edges and the mean of both faces'
// normals, roughly, and for parallel faces [-].
constexpr double kAbout = 0.5;
constexpr double kAlmost = 0.98;

Vector3 find_way(const FacePatch& face, std::size_t edge) {
  return face.find_point(kFaceCorners[(edge + 1) % 3]) -
         face.find_point(kFaceCorners[edge]);
}

// Unit normal of two edges; none if they are nearly parallel.
std::optional<Vector3> find_across(const FacePatch& A, std::size_t edge_A,
                                   const FacePatch& B, std::size_t edge_B,
                                   const Vector3& about, double least_cosine) {
  const Vector3 across =
      find_way(A, edge_A).cross(find_way(B, edge_B)).normalized();
  const double side = across.dot(about);
  if (!(std::abs(side) > least_cosine)) return std::nullopt;
  return side > 0.0 ? across : Vector3(-across);
}

}  // namespace

using Kind = SkinPairSearch::Feature::Kind;

std::optional<FacePairPlace> SkinPairSearch::find_under_corner(
    const FacePair& faces, std::size_t corner, bool is_of_A,
    const Vector3& normal) const {
  const FacePatch& from = is_of_A ? faces.A : faces.B;
  const FacePatch& to = is_of_A ? faces.B : faces.A;
  const double sign = is_of_A ? 1.0 : -1.0;
  const Vector3 p = from.find_point(kFaceCorners[corner]);
  const FacePlace at = to.find_nearest(p, to.find_nearest_of_flat(p).at);
  const Vector3 out = to.find_normal(at).normalized();
  const Vector3 arm = p - to.find_point(at);
  const double height = out.dot(arm);
  if ((arm - height * out).norm() > kSamePlace * edge_) return std::nullopt;
  if (out.dot(-sign * normal) < 0.5) return std::nullopt;
  return FacePairPlace{.on_A = is_of_A ? kFaceCorners[corner] : at,
                       .on_B = is_of_A ? at : kFaceCorners[corner],
                       .normal = -sign * out,
                       .depth = -height};
}

std::optional<FacePairPlace> SkinPairSearch::find_edges_crossing(
    const FacePair& faces, std::size_t edge_A, std::size_t edge_B,
    const Vector3& normal) {
  const auto at =
      find_crossing(faces.A.find_point(kFaceCorners[edge_A]),
                    faces.A.find_point(kFaceCorners[(edge_A + 1) % 3]),
                    faces.B.find_point(kFaceCorners[edge_B]),
                    faces.B.find_point(kFaceCorners[(edge_B + 1) % 3]), normal);
  if (!at) return std::nullopt;
  FacePairPlace pair{.on_A = find_between(edge_A, at->s),
                     .on_B = find_between(edge_B, at->t),
                     .normal = normal};
  pair.depth =
      normal.dot(faces.A.find_point(pair.on_A) - faces.B.find_point(pair.on_B));
  return pair;
}

void SkinPairSearch::add_flat(const FacePair& faces, Feature::Kind kind,
                              const FacePairPlace& pair, bool is_outer) {
  if (-pair.depth > limit() ||
      !is_in_range(faces.face_A, faces.face_B, pair.depth)) {
    return;
  }
  Feature feature =
      make_feature(faces.face_A, faces.A, faces.face_B, faces.B, pair);
  feature.kind = kind;
  feature.is_outer = is_outer;
  add(feature);
}

void SkinPairSearch::look_at_corners(const FacePair& faces,
                                     const Vector3& normal) {
  const auto& is_corner_A = A_.skin.measures(faces.face_A).is_corner;
  const auto& is_corner_B = B_.skin.measures(faces.face_B).is_corner;
  for (std::size_t i = 0; i < 3; ++i) {
    if (const auto at = find_under_corner(faces, i, true, normal)) {
      add_flat(faces, Kind::kCornerOfA, *at, is_corner_A[i]);
    }
    if (const auto at = find_under_corner(faces, i, false, normal)) {
      add_flat(faces, Kind::kCornerOfB, *at, is_corner_B[i]);
    }
  }
}

void SkinPairSearch::look_at_edges(const FacePair& faces,
                                   const Vector3& normal) {
  const auto& is_rim_A = A_.skin.measures(faces.face_A).is_rim;
  const auto& is_rim_B = B_.skin.measures(faces.face_B).is_rim;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const Vector3 n =
          find_across(faces.A, i, faces.B, j, normal, kAlmost).value_or(normal);
      const auto at = find_edges_crossing(faces, i, j, n);
      if (!at) continue;
      const bool is_outer = is_rim_A[i] && is_rim_B[j];
      if (!is_outer && !is_summit(faces.face_A, faces.face_B, *at, kRises)) {
        continue;
      }
      add_flat(faces, Kind::kCrossing, *at, is_outer);
    }
  }
}

void SkinPairSearch::look_at_ridges(const FacePair& faces,
                                    const Vector3& normal) {
  const Skin::FaceMeasures& of_A = A_.skin.measures(faces.face_A);
  const Skin::FaceMeasures& of_B = B_.skin.measures(faces.face_B);
  const auto put = [&](Kind kind, const std::optional<FacePairPlace>& at) {
    if (at && is_summit(faces.face_A, faces.face_B, *at, kLeans)) {
      add_flat(faces, kind, *at, true);
    }
  };
  for (std::size_t i = 0; i < 3; ++i) {
    if (of_A.is_corner[i]) {
      put(Kind::kCornerOfA, find_under_corner(faces, i, true, normal));
    }
    if (of_B.is_corner[i]) {
      put(Kind::kCornerOfB, find_under_corner(faces, i, false, normal));
    }
    for (std::size_t j = 0; j < 3; ++j) {
      if (!of_A.is_rim[i] || !of_B.is_rim[j]) continue;
      const auto n = find_across(faces.A, i, faces.B, j, normal, kAbout);
      if (n) put(Kind::kCrossing, find_edges_crossing(faces, i, j, *n));
    }
  }
}

bool SkinPairSearch::is_genuine_of_flat(const Feature& feature) const {
  const double depth = feature.at.depth;
  const Vector3& n = feature.at.normal;
  const Vector3 p = feature.middle + 0.5 * depth * n;
  constexpr double kInside = 0.3;  // of the depth, that is clearly so [-]
  if (find_height(B_, p) <= -kInside * depth ||
      find_height(A_, p - depth * n) <= -kInside * depth) {
    return true;
  }
  // At the rim of both, a step to some side leads along A's face into B. Over
  // the depth: the step, the depth reached, the distance from A's face [-].
  constexpr double kStep = 0.25;
  constexpr double kLeast = 0.1;
  constexpr double kMost = 0.7 * kStep;
  // The first is towards the middles of both faces.
  constexpr std::array<double, 8> kTurns = {0.0,  1.0, -1.0, 2.0,
                                            -2.0, 3.0, -3.0, 4.0};
  constexpr double kTurn = 0.25 * std::numbers::pi;
  const Vector3 middle =
      0.5 * (A_.skin.make_patch(feature.face_A, A_.eta, Pose{})
                 .find_point(kFaceMiddle) +
             B_.skin.make_patch(feature.face_B, B_.eta, X_AB_)
                 .find_point(kFaceMiddle));
  const Vector3 first = (middle - p - n.dot(middle - p) * n).normalized();
  const Vector3 second = n.cross(first);
  return std::any_of(kTurns.begin(), kTurns.end(), [&](double turns) {
    const double angle = kTurn * turns;
    const Vector3 probe =
        p +
        kStep * depth * (std::cos(angle) * first + std::sin(angle) * second);
    if (!(find_height(B_, probe) <= -kLeast * depth)) return false;
    const auto on_A = A_.skin.find_nearest(probe, A_.eta, kInfinity, kInfinity);
    return on_A && std::abs(on_A->nearest.distance) <= kMost * depth;
  });
}

bool SkinPairSearch::is_along_ridge(int face_A, int face_B,
                                    const FacePairPlace& at) const {
  constexpr double kOnEdge = 1e-6;  // weight of the opposite corner [-]
  const Skin::FaceMeasures& of_A = A_.skin.measures(face_A);
  const Skin::FaceMeasures& of_B = B_.skin.measures(face_B);
  const auto is_on = [](const FacePlace& place,
                        const std::array<bool, 3>& edges,
                        const std::array<bool, 3>& corners) {
    const auto weights = place.weights();
    for (std::size_t i = 0; i < 3; ++i) {
      if (edges[i] && weights[(i + 2) % 3] <= kOnEdge) return true;
      if (corners[i] && weights[i] >= 1.0 - kOnEdge) return true;
    }
    return false;
  };
  const auto is_along =
      [&](const FacePlace& on_edge, const Skin::FaceMeasures& of_edge,
          const FacePlace& on_plane, const Skin::FaceMeasures& of_plane) {
        return of_plane.is_plane &&
               is_on(on_edge, of_edge.is_ridge, of_edge.is_on_ridge) &&
               !is_on(on_plane, of_plane.is_rim, of_plane.is_on_rim);
      };
  return is_along(at.on_A, of_A, at.on_B, of_B) ||
         is_along(at.on_B, of_B, at.on_A, of_A);
}

}  // namespace limber::contact
