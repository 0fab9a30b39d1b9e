// SPDX-License-Identifier: BSD-3-Clause
// Parts of Skin that contacts of two surfaces need.
#include <algorithm>
#include <cmath>

#include "limber/contact/shapes/skin.hpp"

namespace limber::contact {
namespace {

// Whether a ray from `from` may meet a box, within `most`.
bool may_meet(const SkinTree::Box& box, const Vector3& from, const Vector3& way,
              double most) {
  double first = 0.0;
  double last = most;
  for (int axis = 0; axis < 3; ++axis) {
    const double arm = box.centre[axis] - from[axis];
    const double half = box.half[axis];
    if (std::abs(way[axis]) < 1e-300) {
      if (std::abs(arm) > half) return false;
      continue;
    }
    const double a = (arm - half) / way[axis];
    const double b = (arm + half) / way[axis];
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  }
  return first <= last;
}

// Distance to a flat triangle along a ray; infinite if it misses [@moller1997].
double find_way_to(const Vector3& a, const Vector3& b, const Vector3& c,
                   const Vector3& from, const Vector3& way) {
  const Vector3 ab = b - a;
  const Vector3 ac = c - a;
  const Vector3 h = way.cross(ac);
  const double determinant = ab.dot(h);
  if (determinant == 0.0) return kInfinity;
  const Vector3 s = from - a;
  const Vector3 q = s.cross(ab);
  const double u = s.dot(h) / determinant;
  const double v = way.dot(q) / determinant;
  if (u < 0.0 || v < 0.0 || u + v > 1.0) return kInfinity;
  return ac.dot(q) / determinant;
}

}  // namespace

FacePatch Skin::make_patch(int f, const ModalView& eta, const Pose& X) const {
  const Face& nodes = face(f);
  if (nodes[3] < 0) {
    return FacePatch(std::array<Vector3, 3>{X * deform(nodes[0], eta),
                                            X * deform(nodes[1], eta),
                                            X * deform(nodes[2], eta)});
  }
  std::array<Vector3, 6> x;
  for (std::size_t i = 0; i < 6; ++i) x[i] = X * deform(nodes[i], eta);
  return FacePatch(x);
}

FacePatch Skin::make_undeformed_patch(int f) const {
  const Face& nodes = face(f);
  std::array<Vector3, 6> x;
  for (std::size_t i = 0; i < 6; ++i) {
    if (nodes[i] >= 0) x[i] = surface_.x_B.col(nodes[i]);
  }
  return nodes[3] < 0 ? FacePatch(std::array{x[0], x[1], x[2]}) : FacePatch(x);
}

int Skin::find_neighbour(int f, int edge) const {
  const int a = face(f)[index(edge)];
  const int b = face(f)[index((edge + 1) % 3)];
  for (const int other : find_faces_of(a)) {
    const Face& corners = face(other);
    const bool has_b = corners[0] == b || corners[1] == b || corners[2] == b;
    if (other != f && has_b) return other;
  }
  return -1;
}

void Skin::measure_flat_area() {
  const Eigen::Index m = modes_.rows();
  flat_area_by_modes_ = Matrix3X::Zero(3, m);
  for (int f = 0; f < static_cast<int>(face_count()); ++f) {
    const Face& n = face(f);
    const Vector3 a = surface_.x_B.col(n[1]) - surface_.x_B.col(n[0]);
    const Vector3 b = surface_.x_B.col(n[2]) - surface_.x_B.col(n[0]);
    flat_area_ += 0.5 * a.cross(b);
    for (Eigen::Index k = 0; k < m; ++k) {
      const auto move = [&](std::size_t corner) -> Vector3 {
        return modes_.block<1, 3>(k, 3 * n[corner]) -
               modes_.block<1, 3>(k, 3 * n[0]);
      };
      flat_area_by_modes_.col(k) += 0.5 * (move(1).cross(b) + a.cross(move(2)));
    }
  }
}

Vector3 Skin::find_mean_normal(const ModalView& eta) const {
  Vector3 area = flat_area_;
  for (Eigen::Index k = 0; k < eta.size(); ++k) {
    area += eta[k] * flat_area_by_modes_.col(k);
  }
  return area.normalized();
}

void Skin::measure() {
  constexpr double kSharpCosine = 0.94;  // of 20 degrees
  constexpr double kSameNormal = 1e-6;   // sine, and bulge of an edge
  constexpr double kMiddle = 1.0 / 3.0;
  constexpr double kNearCorner = 0.1;
  const auto at = [this](int node) -> Vector3 {
    return surface_.x_B.col(node);
  };
  const auto find_normal = [&](int f) -> Vector3 {
    const Face& n = face(f);
    return (at(n[1]) - at(n[0])).cross(at(n[2]) - at(n[0])).normalized();
  };
  measures_.resize(face_count());
  double sum = 0.0;
  for (int f = 0; f < static_cast<int>(face_count()); ++f) {
    FaceMeasures& of = measures_[index(f)];
    const Face& nodes = face(f);
    for (int edge = 0; edge < 3; ++edge) {
      const int a = nodes[index(edge)];
      const int b = nodes[index((edge + 1) % 3)];
      of.edge += (at(b) - at(a)).norm() / 3.0;
      const int other = find_neighbour(f, edge);
      if (other < 0) continue;
      const Face& beyond = face(other);
      Vector3 far = at(a);
      for (std::size_t i = 0; i < 3; ++i) {
        if (beyond[i] != a && beyond[i] != b) far = at(beyond[i]);
      }
      const Vector3 normal = find_normal(f);
      const Vector3 beside = find_normal(other);
      of.is_sharp[index(edge)] =
          normal.dot(far - at(a)) < 0.0 && normal.dot(beside) < kSharpCosine;
      of.is_plane = of.is_plane && (of.is_sharp[index(edge)] ||
                                    normal.cross(beside).norm() < kSameNormal);
      of.overshoot = std::max(of.overshoot, find_overshoot(f, edge, other));
    }
    of.is_plane = of.is_plane &&
                  make_undeformed_patch(f).find_bulge() < kSameNormal * of.edge;
    for (const FacePlace& place :
         {FacePlace{kMiddle, kMiddle}, FacePlace{kNearCorner, kNearCorner},
          FacePlace{1.0 - 2.0 * kNearCorner, kNearCorner},
          FacePlace{kNearCorner, 1.0 - 2.0 * kNearCorner}}) {
      of.thickness = std::min(of.thickness, find_thickness(f, place));
    }
    longest_edge_ = std::max(longest_edge_, of.edge);
    sum += of.edge;
  }
  mean_edge_ = sum / static_cast<double>(face_count());
  mark_rims();
}

std::size_t Skin::find_corner(int f, int node) const {
  const Face& corners = face(f);
  return corners[0] == node ? 0 : corners[1] == node ? 1 : 2;
}

// Two faces meet at an angle, which the extended face reaches at this distance:
// the angle over the curvature across the edge.
double Skin::find_overshoot(int f, int edge, int other) const {
  constexpr double kSmooth = 1e-6;  // sine
  const FacePatch patch = make_undeformed_patch(f);
  const FacePatch beyond = make_undeformed_patch(other);
  const auto first = static_cast<std::size_t>(edge);
  const std::size_t second = (first + 1) % 3;
  const FacePlace& far = kFaceCorners[(first + 2) % 3];
  const auto find_beyond = [&](std::size_t corner) {
    return kFaceCorners[find_corner(other, face(f)[corner])];
  };
  const FacePlace& first_beyond = find_beyond(first);
  const FacePlace& second_beyond = find_beyond(second);
  double longest = 0.0;
  for (const double s : {0.0, 0.5, 1.0}) {
    const FacePlace at = find_between(first, s);
    const Vector3 normal = patch.find_normal(at).normalized();
    const Vector3 beside =
        beyond.find_normal(find_between(first_beyond, second_beyond, s))
            .normalized();
    const double angle = normal.cross(beside).norm();
    if (angle < kSmooth) continue;
    const double turn =
        normal.cross(patch.find_normal(far).normalized()).norm();
    const double way = (patch.find_point(far) - patch.find_point(at)).norm();
    longest = std::max(longest, turn > 0.0 ? angle / turn * way : kInfinity);
  }
  return longest;
}

// A node with sharp edges or borders is on an edge; unless these are two in a
// straight line, it is a corner.
void Skin::mark_rims() {
  constexpr double kStraight = 0.996;    // cosine of 5 degrees
  constexpr double kNoTurn = 0.9999995;  // of 1e-3 rad
  const std::size_t n = node_count();
  std::vector<int> counts(n, 0);
  std::vector<Vector3> sums(n, Vector3::Zero());
  const auto add = [&](int node, int other) {
    const Vector3 way = surface_.x_B.col(other) - surface_.x_B.col(node);
    ++counts[index(node)];
    sums[index(node)] += way.normalized();
  };
  for (std::size_t f = 0; f < face_count(); ++f) {
    for (std::size_t edge = 0; edge < 3; ++edge) {
      if (!measures_[f].is_sharp[edge] && !is_border_[f][edge]) continue;
      const int a = surface_.faces[f][edge];
      const int b = surface_.faces[f][(edge + 1) % 3];
      add(a, b);
      add(b, a);
    }
  }
  // Inner edges count twice. For two directions |sum|^2 = 2 + 2 cos, from both
  // faces 4 times that.
  const double straight = 8.0 * (1.0 - kStraight);
  const auto is_corner = [&](std::size_t node) {
    return counts[node] > 4 || sums[node].squaredNorm() > straight;
  };
  const auto goes_on = [&](std::size_t node) {
    return !is_corner(node) && sums[node].squaredNorm() < 8.0 * (1.0 - kNoTurn);
  };
  for (std::size_t f = 0; f < face_count(); ++f) {
    FaceMeasures& of = measures_[f];
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t node = index(surface_.faces[f][i]);
      if (counts[node] == 0) continue;
      of.overshoot = kInfinity;
      of.is_on_rim[i] = true;
      of.is_on_ridge[i] = goes_on(node);
      of.is_corner[i] = is_corner(node);
    }
    for (std::size_t edge = 0; edge < 3; ++edge) {
      const std::size_t a = edge;
      const std::size_t b = (edge + 1) % 3;
      of.is_rim[edge] = of.is_sharp[edge] || is_border_[f][edge];
      of.is_ridge[edge] = of.is_rim[edge] &&
                          (of.is_corner[a] || of.is_on_ridge[a]) &&
                          (of.is_corner[b] || of.is_on_ridge[b]);
    }
  }
}

double Skin::find_thickness(int f, const FacePlace& from) const {
  const Face& start = face(f);
  const auto at = [this](int node) -> Vector3 {
    return surface_.x_B.col(node);
  };
  const Vector3 ab = at(start[1]) - at(start[0]);
  const Vector3 ac = at(start[2]) - at(start[0]);
  const Vector3 p = at(start[0]) + from.u * ab + from.v * ac;
  const Vector3 way = -ab.cross(ac).normalized();
  double least = kInfinity;
  std::array<int, SkinTree::kMostLevels> stack{};
  std::size_t size = 1;
  while (size > 0) {
    const int i = stack[--size];
    if (!may_meet(tree_.undeformed_box(i), p, way, least)) continue;
    const SkinTree::Node& node = tree_.node(i);
    if (!node.is_leaf()) {
      stack[size++] = node.right;
      stack[size++] = i + 1;
      continue;
    }
    for (const int g : tree_.find_faces(node)) {
      const Face& n = face(g);
      if (g == f) continue;
      // Neighbours that rise inward are not the opposite side.
      const Vector3 normal = (at(n[1]) - at(n[0])).cross(at(n[2]) - at(n[0]));
      if (!(normal.dot(way) > 0.0)) continue;
      const double far = find_way_to(at(n[0]), at(n[1]), at(n[2]), p, way);
      if (far > 0.0) least = std::min(least, far);
    }
  }
  return least;
}

double Skin::find_least_cosine(const SurfacePlace& place, const ModalView& eta,
                               const Vector3& way) const {
  double least = 1.0;
  const auto take = [&](int f, const FacePlace& at) {
    const Vector3 normal = deform_face(f, eta).find_normal(at).normalized();
    least = std::min(least, way.dot(normal));
  };
  take(place.face, {place.u, place.v});
  const auto weights = FacePlace{place.u, place.v}.weights();
  for (std::size_t i = 0; i < 3; ++i) {
    if (weights[i] >= 1.0 - kOnEdge) {
      for (const int f : find_faces_of(face(place.face)[i]))
        take(f, kFaceMiddle);
    } else if (weights[(i + 2) % 3] <= kOnEdge) {
      const int beyond = find_neighbour(place.face, static_cast<int>(i));
      if (beyond >= 0) take(beyond, kFaceMiddle);
    }
  }
  return least;
}

bool Skin::is_summit(const SurfacePlace& place, const ModalView& eta,
                     const Vector3& way, double tolerance) const {
  const auto rises = [&](const Vector3& tangent) {
    return way.dot(tangent) > tolerance * tangent.norm();
  };
  const auto weights = FacePlace{place.u, place.v}.weights();
  const Face& nodes = face(place.face);
  for (std::size_t i = 0; i < 3; ++i) {
    if (weights[i] < 1.0 - kOnEdge) continue;
    for (const int f : find_faces_of(nodes[i])) {
      const std::size_t me = find_corner(f, nodes[i]);
      const FacePatch patch = deform_face(f, eta);
      const FacePlace& at = kFaceCorners[me];
      const Vector3 x_u = patch.find_tangent_u(at);
      const Vector3 x_v = patch.find_tangent_v(at);
      const std::array<Vector3, 2> ways =
          me == 0   ? std::array<Vector3, 2>{x_u, x_v}
          : me == 1 ? std::array<Vector3, 2>{-x_u, x_v - x_u}
                    : std::array<Vector3, 2>{-x_v, x_u - x_v};
      if (rises(ways[0]) || rises(ways[1])) return false;
    }
    return true;
  }
  for (int edge = 0; edge < 3; ++edge) {
    if (weights[index((edge + 2) % 3)] > kOnEdge) continue;
    const int a = nodes[index(edge)];
    const int b = nodes[index((edge + 1) % 3)];
    for (const int f : {place.face, find_neighbour(place.face, edge)}) {
      if (f < 0) continue;  // a border
      std::array<double, 3> there{};
      std::size_t far = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        const int node = face(f)[i];
        if (node == a) there[i] = weights[index(edge)];
        if (node == b) there[i] = weights[index((edge + 1) % 3)];
        if (node != a && node != b) far = i;
      }
      const FacePatch patch = deform_face(f, eta);
      const FacePlace at{there[1], there[2]};
      // Towards the corner opposite to the edge.
      if (rises(patch.find_tangent_u(at) * (kFaceCorners[far].u - at.u) +
                patch.find_tangent_v(at) * (kFaceCorners[far].v - at.v))) {
        return false;
      }
    }
    return true;
  }
  return true;
}

}  // namespace limber::contact
