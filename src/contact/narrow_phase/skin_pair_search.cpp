// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/narrow_phase/skin_pair_search.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace limber::contact {
namespace {

// Largest cosine between normals of sides that face each other [-].
constexpr double kFacing = -0.05;
// The same for parallel sides, and the bulge of flat ones over an edge [-].
constexpr double kParallel = -0.995;
constexpr double kFlatBulge = 0.01;
constexpr double kExactlyFlat = 1e-6;
// First overlap to be looked for, relative to an edge, and its growth [-].
constexpr double kFirstSlack = 0.1;
constexpr double kMoreSlack = 4.0;
// Distance beyond their edges at which places of two faces are still accepted,
// relative to the shorter edge [-].
constexpr double kNearby = 0.2;
constexpr double kShallow = 0.02;  // of an edge [-]

double find_gap(const SkinTree::Box& a, const SkinTree::Box& b) {
  return ((a.centre - b.centre).cwiseAbs() - a.half - b.half)
      .cwiseMax(0.0)
      .norm();
}

bool is_flat(const FacePatch& patch, double edge) {
  return patch.is_straight() || patch.find_bulge() < kFlatBulge * edge;
}

}  // namespace

struct SkinPairSearch::Entry {
  int node_A = 0;
  int node_B = 0;
  SkinTree::Box box_A;
  SkinTree::Box box_B;
  double gap = 0.0;
};

SkinPairSearch::SkinPairSearch(const DeformedSkin& A, const DeformedSkin& B,
                               const Pose& X_AB)
    : A_(A),
      B_(B),
      X_AB_(X_AB),
      spread_(X_AB.R.cwiseAbs()),
      edge_(std::min(A.skin.mean_edge(), B.skin.mean_edge())) {
  deepest_.at.depth = -kInfinity;
}

SkinTree::Box SkinPairSearch::find_box_B(int node) const {
  const SkinTree::Box box = B_.skin.tree().find_box(node, B_.eta);
  return {X_AB_ * box.centre, spread_ * box.half};
}

double SkinPairSearch::limit() const {
  return std::min({reach_, nearest_, std::max(-deepest_.at.depth, 0.0)}) +
         slack_;
}

// Whether there may be an overlap deeper than those looked for.
bool SkinPairSearch::must_look_deeper() const {
  if (!has_overlap_) return false;
  double summit = -kInfinity;
  for (std::size_t i = 0; i < count_; ++i) {
    summit = std::max(summit, features_[i].at.depth);
  }
  return summit == -kInfinity || summit > 0.5 * slack_;
}

void SkinPairSearch::run_to_overlap(double reach) {
  ends_at_overlap_ = true;
  run(reach);
}

// Whether any overlap suffices, and one was found.
bool SkinPairSearch::is_answered() const {
  return ends_at_overlap_ && deepest_.at.depth > kNoDepth * edge_;
}

void SkinPairSearch::run(double reach) {
  reach_ = reach;
  const double most = std::min(A_.skin.find_ball(A_.eta).radius,
                               B_.skin.find_ball(B_.eta).radius);
  slack_ = std::min(kFirstSlack * edge_, most);
  while (true) {
    count_ = 0;
    has_overlap_ = false;
    deepest_.at.depth = -kInfinity;
    least_gap_ = nearest_ = kInfinity;
    descend(reach);
    if (is_answered() || slack_ >= most || looked_ > kMostLooks ||
        !must_look_deeper()) {
      return;
    }
    slack_ = std::min(kMoreSlack * slack_, most);
  }
}

std::array<SkinPairSearch::Entry, 2> SkinPairSearch::split(
    const Entry& entry) const {
  const SkinTree::Node& a = A_.skin.tree().node(entry.node_A);
  const SkinTree::Node& b = B_.skin.tree().node(entry.node_B);
  const bool splits_A =
      b.is_leaf() || (!a.is_leaf() && entry.box_A.half.squaredNorm() >=
                                          entry.box_B.half.squaredNorm());
  std::array<Entry, 2> children = {entry, entry};
  for (std::size_t i = 0; i < 2; ++i) {
    Entry& child = children[i];
    if (splits_A) {
      child.node_A = i == 0 ? entry.node_A + 1 : a.right;
      child.box_A = A_.skin.tree().find_box(child.node_A, A_.eta);
    } else {
      child.node_B = i == 0 ? entry.node_B + 1 : b.right;
      child.box_B = find_box_B(child.node_B);
    }
    child.gap = find_gap(child.box_A, child.box_B);
  }
  return children;
}

double SkinPairSearch::find_box_gap() const {
  std::array<Entry, 2 * SkinTree::kMostLevels> stack;
  std::size_t size = 0;
  stack[size++] = make_root();
  double least = kInfinity;
  while (size > 0) {
    const Entry entry = stack[--size];
    if (entry.gap >= least) continue;
    if (A_.skin.tree().node(entry.node_A).is_leaf() &&
        B_.skin.tree().node(entry.node_B).is_leaf()) {
      least = entry.gap;
      continue;
    }
    for (const Entry& child : split(entry)) stack[size++] = child;
    if (stack[size - 1].gap > stack[size - 2].gap) {
      std::swap(stack[size - 1], stack[size - 2]);
    }
  }
  return least;
}

SkinPairSearch::Entry SkinPairSearch::make_root() const {
  Entry root{.box_A = A_.skin.tree().find_box(0, A_.eta),
             .box_B = find_box_B(0)};
  root.gap = find_gap(root.box_A, root.box_B);
  return root;
}

void SkinPairSearch::descend(double reach) {
  std::array<Entry, 2 * SkinTree::kMostLevels> stack;
  std::size_t size = 0;
  const SkinTree& tree_A = A_.skin.tree();
  const SkinTree& tree_B = B_.skin.tree();
  stack[size++] = make_root();
  if (stack[0].gap > reach) least_gap_ = stack[0].gap;
  while (size > 0 && !is_answered()) {
    const Entry entry = stack[--size];
    if (entry.gap > limit()) continue;
    const SkinTree::Node& a = tree_A.node(entry.node_A);
    const SkinTree::Node& b = tree_B.node(entry.node_B);
    if (a.is_leaf() && b.is_leaf()) {
      look_at_leaves(entry);
      continue;
    }
    for (const Entry& child : split(entry)) stack[size++] = child;
    // The nearer one comes first.
    if (stack[size - 1].gap > stack[size - 2].gap) {
      std::swap(stack[size - 1], stack[size - 2]);
    }
  }
}

void SkinPairSearch::look_at_leaves(const Entry& entry) {
  const auto faces_A =
      A_.skin.tree().find_faces(A_.skin.tree().node(entry.node_A));
  const auto faces_B =
      B_.skin.tree().find_faces(B_.skin.tree().node(entry.node_B));
  least_gap_ = std::min(least_gap_, entry.gap);
  std::array<std::optional<FacePatch>, SkinTree::kLeafFaces> patches_B;
  for (std::size_t j = 0; j < faces_B.size(); ++j) {
    patches_B[j].emplace(B_.skin.make_patch(faces_B[j], B_.eta, X_AB_));
  }
  for (const int f : faces_A) {
    const FacePatch A = A_.skin.make_patch(f, A_.eta, Pose{});
    for (std::size_t j = 0; j < faces_B.size(); ++j) {
      look_at(f, A, faces_B[j], *patches_B[j], entry.gap == 0.0);
    }
  }
}

void SkinPairSearch::look_at(int face_A, const FacePatch& A, int face_B,
                             const FacePatch& B, bool do_boxes_meet) {
  ++looked_;
  const Vector3 normal_A = A.find_normal(kFaceMiddle).normalized();
  const Vector3 normal_B = B.find_normal(kFaceMiddle).normalized();
  const double cosine = normal_A.dot(normal_B);
  if (!(cosine < kFacing)) return;
  has_overlap_ = has_overlap_ || do_boxes_meet;
  const Vector3 normal = (normal_A - normal_B).normalized();
  const Vector3 arm = B.find_point(kFaceMiddle) - A.find_point(kFaceMiddle);
  nearest_ = std::min(nearest_, arm.norm());
  const FacePatch::Range on_A = A.find_range(normal);
  const FacePatch::Range on_B = B.find_range(normal);
  if (on_B.low - on_A.high > limit()) return;
  if (!is_in_range(face_A, face_B, on_A.low - on_B.high)) return;
  if (are_apart_along(normal_A, A, B) || are_apart_along(-normal_B, A, B) ||
      are_apart_along(arm.normalized(), A, B)) {
    return;
  }
  if (is_flat(A, edge_) && is_flat(B, edge_)) {
    const FacePair faces{face_A, A, face_B, B};
    if (cosine < kParallel) {
      look_at_corners(faces, normal);
      look_at_edges(faces, normal);
      // Flat faces need nothing else.
      if (is_flat(A, kExactlyFlat * edge_) &&
          is_flat(B, kExactlyFlat * edge_)) {
        return;
      }
    } else {
      look_at_ridges(faces, normal);
    }
  }
  const auto at =
      find_opposite(A, B, normal, slack_, are_inner(face_A, face_B));
  if (!at || !is_in_range(face_A, face_B, at->depth)) return;
  if (-at->depth > limit()) return;
  Feature feature = make_feature(face_A, A, face_B, B, *at);
  feature.is_outer = !is_along_ridge(face_A, face_B, *at);
  if (at->depth > deepest_.at.depth && is_genuine(feature)) deepest_ = feature;
  if (is_summit(face_A, face_B, *at, kRises)) add(feature);
}

// Whether all places of two faces are too far apart along `way`, a unit vector
// from A to B, to count.
bool SkinPairSearch::are_apart_along(const Vector3& way, const FacePatch& A,
                                     const FacePatch& B) const {
  return B.find_range(way).low - A.find_range(way).high >
         limit() + kSamePlace * edge_;
}

// The far sides of a thin part face away from each other and do not
// overlap.
bool SkinPairSearch::is_in_range(int face_A, int face_B, double depth) const {
  return depth <= slack_ && depth <= 0.5 * (A_.skin.measures(face_A).thickness +
                                            B_.skin.measures(face_B).thickness);
}

bool SkinPairSearch::are_inner(int face_A, int face_B) const {
  const Skin::FaceMeasures& A = A_.skin.measures(face_A);
  const Skin::FaceMeasures& B = B_.skin.measures(face_B);
  return A.overshoot + B.overshoot <= kNearby * std::min(A.edge, B.edge);
}

// Height of a point in A's frame above a surface, < 0 inside.
double SkinPairSearch::find_height(const DeformedSkin& over,
                                   const Vector3& p) const {
  const Vector3 at = &over == &A_ ? p : X_AB_.inverse() * p;
  const auto hit = over.skin.find_nearest(at, over.eta, kInfinity, kInfinity);
  if (!hit) return kInfinity;
  if (over.skin.is_closed()) return hit->nearest.distance;
  // Beyond a border the face's plane is extended.
  const SurfacePlace& place = hit->place;
  const Vector3 normal = over.skin.make_patch(place.face, over.eta, Pose{})
                             .find_normal({place.u, place.v});
  return normal.normalized().dot(at - hit->nearest.point);
}

bool SkinPairSearch::is_genuine(const Feature& feature) const {
  constexpr double kLeast = 0.3;  // of the depth [-]
  constexpr double kLeastCosine = 0.05;
  const double depth = feature.at.depth;
  if (!(depth > kNoDepth * edge_)) return true;
  if (feature.kind != Feature::Kind::kOpposite) {
    return is_genuine_of_flat(feature);
  }
  const Vector3 half = 0.5 * depth * feature.at.normal;
  const Vector3 a = feature.middle + half;
  // Above an edge or a corner its own sides are nearer than the depth.
  const auto find_least = [&](const DeformedSkin& in, const SurfacePlace& at,
                              const Vector3& out) {
    const double cosine = in.skin.find_least_cosine(at, in.eta, out);
    return kLeast * std::max(cosine, kLeastCosine) * depth;
  };
  const auto& [on_A, on_B, normal, unused] = feature.at;
  return find_height(B_, a) <=
             -find_least(B_, {.face = feature.face_B, .u = on_B.u, .v = on_B.v},
                         -(X_AB_.R.transpose() * normal)) ||
         find_height(A_, feature.middle - half) <=
             -find_least(A_, {.face = feature.face_A, .u = on_A.u, .v = on_A.v},
                         normal);
}

bool SkinPairSearch::is_summit(int face_A, int face_B, const FacePairPlace& at,
                               double tolerance) const {
  const SurfacePlace on_A{.face = face_A, .u = at.on_A.u, .v = at.on_A.v};
  const SurfacePlace on_B{.face = face_B, .u = at.on_B.u, .v = at.on_B.v};
  return A_.skin.is_summit(on_A, A_.eta, at.normal, tolerance) &&
         B_.skin.is_summit(on_B, B_.eta, -(X_AB_.R.transpose() * at.normal),
                           tolerance);
}

SkinPairSearch::Feature SkinPairSearch::make_feature(
    int face_A, const FacePatch& A, int face_B, const FacePatch& B,
    const FacePairPlace& at) const {
  const double curvature =
      A.find_mean_curvature(at.on_A) + B.find_mean_curvature(at.on_B);
  return {.kind = Feature::Kind::kOpposite,
          .face_A = face_A,
          .face_B = face_B,
          .at = at,
          .middle = 0.5 * (A.find_point(at.on_A) + B.find_point(at.on_B)),
          .curvature = std::max(0.0, curvature)};
}

// The choice must not depend on round-off: a corner on a rim, or a place on an
// edge of the mesh, would change its normal at every evaluation.
SkinPairSearch::Feature SkinPairSearch::choose(const Feature& a,
                                               const Feature& b) const {
  const double deeper = b.at.depth - a.at.depth;
  const bool are_same =
      std::abs(deeper) <= kSamePlace * std::abs(a.at.depth) + kNoDepth * edge_;
  const auto order = [](const Feature& feature) {
    return std::pair(feature.face_A, feature.face_B);
  };
  const bool is_b_first = a.kind != b.kind ? b.kind > a.kind
                          : are_same       ? order(b) < order(a)
                                           : deeper > 0.0;
  const Feature& first = is_b_first ? b : a;
  Feature chosen = is_genuine(first) ? first : is_b_first ? a : b;
  chosen.is_outer = a.is_outer || b.is_outer;
  return chosen;
}

void SkinPairSearch::add(const Feature& feature) {
  // Flat faces give many shallow features; only those that count are tested.
  if (feature.at.depth > kShallow * edge_ && !is_genuine(feature)) return;
  if (feature.at.depth > deepest_.at.depth) deepest_ = feature;
  // Corners of flat parts come before inner nodes.
  const auto is_less = [](const Feature& a, const Feature& b) {
    return a.is_outer != b.is_outer ? b.is_outer : a.at.depth < b.at.depth;
  };
  std::size_t least = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    const double far = (features_[i].middle - feature.middle).norm();
    if (far < kSamePlace * edge_) {
      features_[i] = choose(features_[i], feature);
      return;
    }
    if (is_less(features_[i], features_[least])) least = i;
  }
  if (count_ < kMostFeatures) {
    features_[count_++] = feature;
  } else if (is_less(features_[least], feature)) {
    features_[least] = feature;
  }
}

}  // namespace limber::contact
