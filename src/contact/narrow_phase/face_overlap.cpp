// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/narrow_phase/face_overlap.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "limber/common/errors.hpp"

namespace limber::contact {
namespace {

using Vector2 = Eigen::Vector2d;

// Distance, relative to the circumference, at which corners are merged [-].
constexpr double kSame = 1e-6;
// Distance from a line, relative to its length, at which a corner is on it [-].
constexpr double kOnLine = 1e-12;

// Edges have the numbers of the corners that they start from, those of B after
// A's.
constexpr std::size_t kMostEdges = 2 * ConvexFace::kMostCorners;

// A convex polygon in the plane normal to n; edge i starts from corner i.
struct Polygon {
  std::array<Vector2, kMostEdges> corners;
  std::array<std::size_t, kMostEdges> edges{};
  std::size_t count = 0;

  void add(const Vector2& corner, std::size_t edge) {
    if (count < kMostEdges) {
      corners[count] = corner;
      edges[count++] = edge;
    }
  }
};

double cross(const Vector2& a, const Vector2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// Two unit vectors that with n form a right-handed frame.
struct Plane {
  Vector3 n, e1, e2;

  [[nodiscard]] Vector2 project(const Vector3& x) const {
    return {e1.dot(x), e2.dot(x)};
  }
};

// A face in that plane, anticlockwise, and its height above the plane.
class Cover {
 public:
  Cover(const ConvexFace& face, const Plane& plane)
      : face_(face), plane_(plane) {
    for (std::size_t i = 0; i < face.count; ++i) {
      corners_[i] = plane.project(face.corners[i]);
    }
    if (face.count < 3) return;
    const Vector2 a = corners_[1] - corners_[0];
    const Vector2 b = corners_[2] - corners_[0];
    is_turned_ = cross(a, b) < 0.0;
    const Vector3 normal = (face.corners[1] - face.corners[0])
                               .cross(face.corners[2] - face.corners[0]);
    const double along = normal.dot(plane.n);
    slope_ = -Vector2(normal.dot(plane.e1), normal.dot(plane.e2)) / along;
  }

  // Index of corner i in anticlockwise order.
  [[nodiscard]] std::size_t turn(std::size_t i) const {
    return is_turned_ ? face_.count - 1 - i : i;
  }
  [[nodiscard]] const Vector2& corner(std::size_t i) const {
    return corners_[turn(i)];
  }
  [[nodiscard]] std::size_t count() const { return face_.count; }
  // The face's point above a place in the plane.
  [[nodiscard]] Vector3 lift(const Vector2& at) const {
    const Vector3 base = at.x() * plane_.e1 + at.y() * plane_.e2;
    const double height = plane_.n.dot(face_.corners[0]);
    if (face_.count > 2) {
      return base + (height + slope_.dot(at - corners_[0])) * plane_.n;
    }
    const Vector2 way = corners_[1] - corners_[0];
    const double t = (at - corners_[0]).dot(way) / way.squaredNorm();
    const double other = plane_.n.dot(face_.corners[1]);
    return base + (height + t * (other - height)) * plane_.n;
  }

 private:
  const ConvexFace& face_;
  const Plane& plane_;
  std::array<Vector2, ConvexFace::kMostCorners> corners_;
  Vector2 slope_ = Vector2::Zero();
  bool is_turned_ = false;
};

// The part of a polygon left of the line from a to b, edge `number`.
Polygon cut(const Polygon& polygon, const Vector2& a, const Vector2& b,
            std::size_t number) {
  Polygon rest;
  // A corner on the line counts as left of it, independent of round-off.
  const double none = kOnLine * (b - a).squaredNorm();
  const auto find_side = [&](const Vector2& x) { return cross(b - a, x - a); };
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const std::size_t next = (i + 1) % polygon.count;
    const double here = find_side(polygon.corners[i]);
    const double there = find_side(polygon.corners[next]);
    const bool is_left = here >= -none;
    if (is_left) rest.add(polygon.corners[i], polygon.edges[i]);
    if (is_left == (there >= -none)) continue;
    const double t = std::clamp(here / (here - there), 0.0, 1.0);
    rest.add(
        polygon.corners[i] + t * (polygon.corners[next] - polygon.corners[i]),
        is_left ? number : polygon.edges[i]);
  }
  return rest;
}

class Overlap {
 public:
  Overlap(const Cover& A, const Cover& B, std::size_t corners_A,
          std::size_t corners_B, std::span<OverlapPoint> out)
      : A_(A), B_(B), corners_A_(corners_A), corners_B_(corners_B), out_(out) {}

  bool fill() {
    if (A_.count() == 1 || B_.count() == 1) return false;
    if (A_.count() == 2 && B_.count() == 2) return false;
    if (A_.count() == 2) return fill_line(A_, B_, 0);
    if (B_.count() == 2) return fill_line(B_, A_, corners_A_);
    return fill_area();
  }

 private:
  void put(std::size_t slot, const Vector2& at, double share) {
    OverlapPoint& point = out_[slot];
    const double before = point.share;
    if (!(share > before)) {
      point.share += share;  // of corners that coincide
      return;
    }
    point = {share + before, A_.lift(at), B_.lift(at)};
  }

  // The part of a line within a polygon: its ends have the line's slots.
  bool fill_line(const Cover& line, const Cover& area, std::size_t first_slot) {
    const Vector2& from = line.corner(0);
    const Vector2 way = line.corner(1) - from;
    double begin = 0.0;
    double end = 1.0;
    for (std::size_t i = 0; i < area.count(); ++i) {
      const Vector2& a = area.corner(i);
      const Vector2 edge = area.corner((i + 1) % area.count()) - a;
      const double here = cross(edge, from - a);
      const double slope = cross(edge, way);
      if (slope > 0.0) begin = std::max(begin, -here / slope);
      if (slope < 0.0) end = std::min(end, -here / slope);
      if (slope == 0.0 && here < 0.0) return false;
    }
    // A line through a single corner has one point, independent of round-off.
    if (!(end - begin > kSame)) return false;
    put(first_slot, from + begin * way, 1.0);
    put(first_slot + 1, from + end * way, 1.0);
    return true;
  }

  bool fill_area() {
    Polygon area;
    for (std::size_t i = 0; i < A_.count(); ++i) area.add(A_.corner(i), i);
    for (std::size_t j = 0; j < B_.count(); ++j) {
      area = cut(area, B_.corner(j), B_.corner((j + 1) % B_.count()),
                 A_.count() + j);
    }
    double around = 0.0;
    std::array<double, kMostEdges> lengths{};
    for (std::size_t i = 0; i < area.count; ++i) {
      lengths[i] =
          (area.corners[(i + 1) % area.count] - area.corners[i]).norm();
      around += lengths[i];
    }
    if (!(around > 0.0)) return false;
    const double total =
        static_cast<double>(std::min(A_.count(), B_.count())) / (2.0 * around);
    for (std::size_t i = 0; i < area.count; ++i) {
      const std::size_t before = (i + area.count - 1) % area.count;
      const Vector2& at = area.corners[i];
      const std::size_t slot =
          find_slot_of_corner(at, kSame * around)
              .value_or(find_slot(area.edges[before], area.edges[i]));
      put(slot, at, total * (lengths[before] + lengths[i]));
    }
    return true;
  }

  // If corners and edges coincide the slot must not depend on round-off.
  [[nodiscard]] std::optional<std::size_t> find_slot_of_corner(
      const Vector2& at, double tolerance) const {
    for (std::size_t i = 0; i < A_.count(); ++i) {
      if ((A_.corner(i) - at).norm() < tolerance) return A_.turn(i);
    }
    for (std::size_t j = 0; j < B_.count(); ++j) {
      if ((B_.corner(j) - at).norm() < tolerance) {
        return corners_A_ + B_.turn(j);
      }
    }
    return std::nullopt;
  }

  // Slot of the corner between two edges.
  [[nodiscard]] std::size_t find_slot(std::size_t in, std::size_t out) const {
    const std::size_t n = A_.count();
    if (in < n && out < n) return A_.turn(out);
    if (in >= n && out >= n) return corners_A_ + B_.turn(out - n);
    const std::size_t first = corners_A_ + corners_B_;
    return in < n ? first + 2 * A_.turn(in) : first + 2 * A_.turn(out) + 1;
  }

  const Cover& A_;
  const Cover& B_;
  std::size_t corners_A_;
  std::size_t corners_B_;
  std::span<OverlapPoint> out_;
};

}  // namespace

std::size_t count_overlap_points(std::size_t corners_A, std::size_t corners_B) {
  return 3 * corners_A + corners_B;
}

bool find_overlap(const ConvexFace& A, const ConvexFace& B, const Vector3& n,
                  std::size_t corners_A, std::size_t corners_B,
                  std::span<OverlapPoint> out) {
  LIMBER_EXPECT(out.size() == count_overlap_points(corners_A, corners_B));
  std::fill(out.begin(), out.end(), OverlapPoint{});
  const Vector3 e1 = n.unitOrthogonal();
  const Plane plane{n, e1, n.cross(e1)};
  const Cover cover_A(A, plane);
  const Cover cover_B(B, plane);
  return Overlap(cover_A, cover_B, corners_A, corners_B, out).fill();
}

}  // namespace limber::contact
