// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "limber/contact/shapes/mesh_surface.hpp"

namespace limber::contact {
namespace {

// Angle between the two edges of a face at one of its corners [rad].
double find_angle(const FacePatch& patch, int corner) {
  const FacePlace& at = kFaceCorners[index(corner)];
  const Vector3 x_u = patch.find_tangent_u(at);
  const Vector3 x_v = patch.find_tangent_v(at);
  Vector3 a = x_u;
  Vector3 b = x_v;
  if (corner == 1) {
    a = x_v - x_u;
    b = -x_u;
  } else if (corner == 2) {
    a = -x_v;
    b = x_u - x_v;
  }
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

double square(double x) { return x * x; }

}  // namespace

std::optional<MeshSurface::Candidate> MeshSurface::search(
    const Vector3& p, const ModalView& eta, double most_square) const {
  struct Entry {
    int node;
    double square;
  };
  Candidate best{.face = -1, .at = {}, .square = most_square};
  const auto try_face = [&](int f) {
    const FacePatch patch = deform_face(f, eta);
    const FacePatch::FlatNearest flat = patch.find_nearest_of_flat(p);
    if (patch.is_straight()) {
      if (flat.square < best.square) best = {f, flat.at, flat.square};
      return;
    }
    const double least = std::sqrt(flat.square) - patch.find_bulge();
    if (least > 0.0 && least * least >= best.square) return;
    const FacePlace at = patch.find_nearest(p, flat.at);
    const double found = (patch.find_point(at) - p).squaredNorm();
    if (found < best.square) best = {f, at, found};
  };
  std::array<Entry, SurfaceTree::kMostLevels> stack{};
  std::size_t size = 0;
  stack[size++] = {0, tree_.find_box(0, eta).find_square_distance(p)};
  while (size > 0) {
    const Entry entry = stack[--size];
    if (entry.square >= best.square) continue;
    const SurfaceTree::Node& node = tree_.node(entry.node);
    if (node.is_leaf()) {
      for (const int f : tree_.find_faces(node)) try_face(f);
      continue;
    }
    const int left = entry.node + 1;
    Entry near{left, tree_.find_box(left, eta).find_square_distance(p)};
    Entry far{node.right,
              tree_.find_box(node.right, eta).find_square_distance(p)};
    if (far.square < near.square) std::swap(near, far);
    if (far.square < best.square) stack[size++] = far;
    if (near.square < best.square) stack[size++] = near;
  }
  if (best.face < 0) return std::nullopt;
  return best;
}

Vector3 MeshSurface::sum_corner_normals(int node, const ModalView& eta) const {
  Vector3 sum = Vector3::Zero();
  for (const int f : find_faces_of(node)) {
    const Face& nodes = face(f);
    const int corner = nodes[0] == node ? 0 : nodes[1] == node ? 1 : 2;
    const FacePatch patch = deform_face(f, eta);
    sum += find_angle(patch, corner) *
           patch.find_normal(kFaceCorners[index(corner)]).normalized();
  }
  return sum;
}

Vector3 MeshSurface::sum_edge_normals(int f, int edge, const FacePlace& at,
                                      const ModalView& eta) const {
  const int a = face(f)[index(edge)];
  const int b = face(f)[index((edge + 1) % 3)];
  const double weight_b = at.weights()[index((edge + 1) % 3)];
  Vector3 sum = Vector3::Zero();
  for (const int other : find_faces_of(a)) {
    std::array<double, 3> weights{};
    bool has_b = false;
    for (std::size_t i = 0; i < 3; ++i) {
      const int node = face(other)[i];
      if (node == a) weights[i] = 1.0 - weight_b;
      if (node == b) weights[i] = weight_b;
      has_b = has_b || node == b;
    }
    if (!has_b) continue;
    sum += deform_face(other, eta)
               .find_normal({weights[1], weights[2]})
               .normalized();
  }
  return sum;
}

std::optional<Vector3> MeshSurface::find_pseudo_normal(
    const Candidate& candidate, const FacePatch& patch,
    const ModalView& eta) const {
  const auto weights = candidate.at.weights();
  for (std::size_t i = 0; i < 3; ++i) {
    if (weights[i] < 1.0 - kOnEdge) continue;
    const int node = face(candidate.face)[i];
    if (is_border_node_[index(node)]) return std::nullopt;
    return sum_corner_normals(node, eta);
  }
  for (int edge = 0; edge < 3; ++edge) {
    if (weights[index((edge + 2) % 3)] > kOnEdge) continue;
    if (is_border_[index(candidate.face)][index(edge)]) return std::nullopt;
    return sum_edge_normals(candidate.face, edge, candidate.at, eta);
  }
  return patch.find_normal(candidate.at);
}

std::optional<MeshSurface::Hit> MeshSurface::find_nearest(
    const Vector3& p, const ModalView& eta, double reach,
    double thickness) const {
  // An arm as short as this has no direction.
  constexpr double kNoArm = 1e-12;
  const double bound = radius_ + find_deformation_bound(eta);
  const double far_square = (p - centre_).squaredNorm();
  if (!std::isfinite(far_square + bound)) return Hit{{.distance = kNaN}, {}};
  if (far_square > square(bound + reach)) return std::nullopt;
  double most = is_closed_ ? reach : std::max(reach, thickness);
  if (is_closed_ && tree_.find_box(0, eta).find_square_distance(p) == 0.0) {
    most = std::numeric_limits<double>::infinity();  // it may be deep inside
  }
  const auto found = search(p, eta, square(most));
  if (!found) return std::nullopt;
  const FacePatch patch = deform_face(found->face, eta);
  const Vector3 point = patch.find_point(found->at);
  const Vector3 arm = p - point;
  const double length = arm.norm();
  const auto pseudo = find_pseudo_normal(*found, patch, eta);
  const bool is_outside = !pseudo || pseudo->dot(arm) >= 0.0;
  if (is_outside ? length > reach : !is_closed_ && length > thickness) {
    return std::nullopt;
  }
  const double sign = is_outside ? 1.0 : -1.0;
  Vector3 normal = sign * arm / length;
  if (!(length > kNoArm * radius_)) {
    normal = (pseudo ? *pseudo : patch.find_normal(found->at)).normalized();
  }
  return Hit{.nearest = {.distance = sign * length,
                         .point = point,
                         .normal = normal,
                         .curvature = patch.find_mean_curvature(found->at)},
             .place = make_place(found->face, found->at)};
}

double MeshSurface::find_clearance(const Vector3& p, double radius,
                                   const ModalView& eta) const {
  const double bound = radius_ + find_deformation_bound(eta);
  const double far = (p - centre_).norm() - bound - radius;
  if (far > bound) return far;
  const auto found = search(p, eta, std::numeric_limits<double>::infinity());
  if (!found) return kNaN;  // of a state that is not finite
  const FacePatch patch = deform_face(found->face, eta);
  const Vector3 arm = p - patch.find_point(found->at);
  const double length = arm.norm();
  const auto pseudo = find_pseudo_normal(*found, patch, eta);
  const bool is_outside = !pseudo || pseudo->dot(arm) >= 0.0;
  const bool is_behind = !is_closed_ && length > radius;
  return (is_outside || is_behind ? length : -length) - radius;
}

}  // namespace limber::contact
