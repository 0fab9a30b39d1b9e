// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/shapes/nearest_cores.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace limber::contact {
namespace {

// Distance relative to the sizes that counts as zero [-].
constexpr double kNone = 1e-10;

struct Vertex {
  Vector3 on_A;
  Vector3 on_B;
  Vector3 x;  // on_B - on_A
};

// Weights of the point nearest to the origin, 0 for vertices that it does not
// need.
using Weights = std::array<double, 4>;

struct NearestSoFar {
  Weights weights{};
  double square = std::numeric_limits<double>::infinity();

  void take(const Weights& other, double other_square) {
    if (!(other_square < square)) return;
    weights = other;
    square = other_square;
  }
};

class Simplex {
 public:
  void add(const Vertex& vertex) { vertices_[size_++] = vertex; }

  /// Keeps the vertices that the nearest point needs. @returns its square
  /// distance, 0 if the origin is inside
  double reduce() {
    const NearestSoFar nearest = find_nearest();
    std::size_t kept = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      if (!(nearest.weights[i] > 0.0)) continue;
      vertices_[kept] = vertices_[i];
      weights_[kept++] = nearest.weights[i];
    }
    size_ = kept;
    return nearest.square;
  }

  [[nodiscard]] bool is_full() const { return size_ == 4; }
  [[nodiscard]] bool has(const Vector3& x) const {
    for (std::size_t i = 0; i < size_; ++i) {
      if (vertices_[i].x == x) return true;
    }
    return false;
  }
  [[nodiscard]] NearestOfCores find_points() const {
    NearestOfCores points;
    for (std::size_t i = 0; i < size_; ++i) {
      points.on_A += weights_[i] * vertices_[i].on_A;
      points.on_B += weights_[i] * vertices_[i].on_B;
    }
    return points;
  }

 private:
  [[nodiscard]] const Vector3& x(std::size_t i) const { return vertices_[i].x; }

  void try_vertex(std::size_t i, NearestSoFar& best) const {
    Weights weights{};
    weights[i] = 1.0;
    best.take(weights, x(i).squaredNorm());
  }
  void try_edge(std::size_t i, std::size_t j, NearestSoFar& best) const {
    const Vector3 edge = x(j) - x(i);
    const double length = edge.squaredNorm();
    const double t = length > 0.0 ? -x(i).dot(edge) / length : 0.0;
    if (!(t > 0.0 && t < 1.0)) return;
    Weights weights{};
    weights[i] = 1.0 - t;
    weights[j] = t;
    best.take(weights, (x(i) + t * edge).squaredNorm());
  }
  void try_face(std::size_t i, std::size_t j, std::size_t k,
                NearestSoFar& best) const {
    const Vector3 normal = (x(j) - x(i)).cross(x(k) - x(i));
    const double area = normal.squaredNorm();
    if (!(area > 0.0)) return;
    const double w_i = normal.dot(x(j).cross(x(k))) / area;
    const double w_j = normal.dot(x(k).cross(x(i))) / area;
    const double w_k = 1.0 - w_i - w_j;
    if (!(w_i > 0.0 && w_j > 0.0 && w_k > 0.0)) return;
    Weights weights{};
    weights[i] = w_i;
    weights[j] = w_j;
    weights[k] = w_k;
    // From the point itself: round-off in a sliver must not make it nearer.
    best.take(weights, (w_i * x(i) + w_j * x(j) + w_k * x(k)).squaredNorm());
  }
  [[nodiscard]] bool holds_origin() const {
    constexpr std::array<std::array<std::size_t, 4>, 4> kFaces = {
        {{0, 1, 2, 3}, {0, 1, 3, 2}, {0, 2, 3, 1}, {1, 2, 3, 0}}};
    for (const auto& [i, j, k, other] : kFaces) {
      const Vector3 normal = (x(j) - x(i)).cross(x(k) - x(i));
      const double side = normal.dot(x(other) - x(i));
      if (side == 0.0 || -normal.dot(x(i)) * side < 0.0) return false;
    }
    return true;
  }

  [[nodiscard]] NearestSoFar find_nearest() const {
    NearestSoFar best;
    if (size_ == 4 && holds_origin()) {
      best.take({0.25, 0.25, 0.25, 0.25}, 0.0);
      return best;
    }
    for (std::size_t i = 0; i < size_; ++i) {
      try_vertex(i, best);
      for (std::size_t j = i + 1; j < size_; ++j) {
        try_edge(i, j, best);
        for (std::size_t k = j + 1; k < size_; ++k) try_face(i, j, k, best);
      }
    }
    return best;
  }

  std::array<Vertex, 4> vertices_;
  Weights weights_{};
  std::size_t size_ = 0;
};

Vertex find_vertex(const ConvexCore& A, const ConvexCore& B,
                   const Vector3& along) {
  Vertex vertex{A.find_support_point(along), B.find_support_point(-along), {}};
  vertex.x = vertex.on_B - vertex.on_A;
  return vertex;
}

// Searches from a direction; `along` is then the normal of the widest slab
// between both, of width `width`.
struct Search {
  NearestOfCores points;
  double distance = std::numeric_limits<double>::infinity();
  double width = 0.0;
};

Search search_distance(const ConvexCore& A, const ConvexCore& B, double size,
                       Vector3& along) {
  constexpr int kMostSteps = 60;
  constexpr double kPrecision = 1e-14;  // of the square distance
  Simplex simplex;
  Search found;
  Vector3 nearest = along;
  double square = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kMostSteps; ++i) {
    const Vertex vertex = find_vertex(A, B, nearest);
    const double width = nearest.dot(vertex.x) / nearest.norm();
    if (width > found.width) {
      found.width = width;
      along = nearest;
    }
    const bool is_nearest =
        i > 0 && square - nearest.dot(vertex.x) <= kPrecision * square;
    if (is_nearest || simplex.has(vertex.x)) break;
    Simplex next = simplex;
    next.add(vertex);
    const double least = next.reduce();
    if (!(least < square)) break;  // no progress but round-off
    if (least == 0.0 && found.width > kNone * size) break;  // in a sliver
    simplex = next;
    square = least;
    found.points = simplex.find_points();
    nearest = found.points.on_B - found.points.on_A;
    found.distance = std::sqrt(least);
    if (!(least > 0.0)) break;
  }
  return found;
}

}  // namespace

NearestOfCores find_nearest(const ConvexCore& A, const ConvexCore& B) {
  constexpr int kMostSearches = 4;
  constexpr double kGap = 1e-7;  // between the bounds, of the sizes
  const double size = A.size() + B.size();
  Vector3 along = B.centre() - A.centre();
  if (along.isZero(0.0)) along = Vector3::UnitX();
  Search best;
  double width = 0.0;
  // Slivers between points of a rim may end a search_distance early.
  for (int i = 0; i < kMostSearches; ++i) {
    const Search found = search_distance(A, B, size, along);
    width = std::max(width, found.width);
    if (found.distance < best.distance) best = found;
    if (best.distance - width <= kGap * size) break;
    if (best.distance <= kNone * size && i > 0) break;
    along += 1e-3 * along.norm() * along.unitOrthogonal();
  }
  best.points.overlap = best.distance <= kNone * size;
  return best.points;
}

}  // namespace limber::contact
