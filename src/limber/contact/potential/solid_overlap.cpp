// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/potential/solid_overlap.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "limber/common/errors.hpp"

namespace limber::contact {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

struct PlacedSide {
  const ConvexSolid& solid;
  const Pose& X;

  [[nodiscard]] Vector3 to_own(const Vector3& way) const {
    return X.R.transpose() * way;
  }
  [[nodiscard]] double find_low(const Vector3& way) const {
    return way.dot(X.p) + solid.find_low(to_own(way));
  }
  [[nodiscard]] double find_high(const Vector3& way) const {
    return way.dot(X.p) + solid.find_high(to_own(way));
  }
};

struct Axis {
  Vector3 n = Vector3::UnitZ();
  double overlap = kFar;  // along it [m]
};

// Of the faces of `own`, the one that `other` is least below.
Axis find_axis(const PlacedSide& own, const PlacedSide& other) {
  Axis best;
  for (const ConvexSolid::Face& face : own.solid.faces()) {
    const Vector3 n = own.X.R * face.plane.n;
    const double overlap = face.plane.h + n.dot(own.X.p) - other.find_low(n);
    if (overlap < best.overlap) best = {n, overlap};
    if (!(overlap > 0.0)) break;
  }
  return best;
}

Matrix3 make_axes(const Vector3& n) {
  Matrix3 axes;
  axes.col(2) = n;
  axes.col(0) = n.unitOrthogonal();
  axes.col(1) = n.cross(Vector3(axes.col(0)));
  return axes;
}

struct Bounds {
  Matrix3 axes;
  Vector3 low = Vector3::Constant(-kFar);
  Vector3 high = Vector3::Constant(kFar);

  void intersect(const PlacedSide& side) {
    for (int k = 0; k < 3; ++k) {
      if (!side.solid.is_bounded()) continue;
      low[k] = std::max(low[k], side.find_low(axes.col(k)));
      high[k] = std::min(high[k], side.find_high(axes.col(k)));
    }
  }
  [[nodiscard]] bool is_empty() const {
    return !((high - low).minCoeff() > 0.0);
  }
  void grow(double fraction) {
    const Vector3 by = fraction * (high - low);
    low -= by;
    high += by;
  }
};

// @return whether anything is left
bool cut(const PlacedSide& side, int number, const Bounds& bounds,
         Cutter& cutter) {
  const Vector3 middle =
      side.to_own(bounds.axes * (0.5 * (bounds.low + bounds.high)) - side.X.p);
  const Matrix3 halves = (side.X.R.transpose() * bounds.axes) *
                         (0.5 * (bounds.high - bounds.low)).asDiagonal();
  for (std::size_t i = 0; i < side.solid.faces().size(); ++i) {
    const Plane& plane = side.solid.faces()[i].plane;
    const double reach = (plane.n.transpose() * halves).cwiseAbs().sum();
    if (plane.find_depth(middle) >= reach) continue;
    const Vector3 n = side.X.R * plane.n;
    const int tag = ConvexSolid::tag_of(static_cast<int>(i), number);
    if (!cutter.cut({n, plane.h + n.dot(side.X.p)}, tag)) return false;
  }
  return true;
}

bool are_balls_apart(const PlacedSide& A, const PlacedSide& B) {
  if (!A.solid.is_bounded() || !B.solid.is_bounded()) return false;
  const ConvexSolid::Ball& a = A.solid.ball();
  const ConvexSolid::Ball& b = B.solid.ball();
  return (A.X * a.centre - B.X * b.centre).norm() > a.radius + b.radius;
}

}  // namespace

void find_overlap(const ConvexSolid& A, const Pose& X_A, const ConvexSolid& B,
                  const Pose& X_B, Polytope& out) {
  constexpr double kMargin = 0.05;
  const PlacedSide of_A{A, X_A};
  const PlacedSide of_B{B, X_B};
  LIMBER_EXPECT(A.is_bounded() || B.is_bounded());
  out.clear();
  if (are_balls_apart(of_A, of_B)) return;
  Axis axis;
  if (B.is_bounded()) axis = find_axis(of_A, of_B);
  if (!(axis.overlap > 0.0)) return;
  if (A.is_bounded()) {
    const Axis other = find_axis(of_B, of_A);
    if (other.overlap < axis.overlap) axis = other;
  }
  if (!(axis.overlap > 0.0)) return;
  Bounds bounds{.axes = make_axes(axis.n)};
  bounds.intersect(of_A);
  bounds.intersect(of_B);
  // The bounded one reaches no deeper into a half space.
  if (!A.is_bounded() || !B.is_bounded()) {
    bounds.high[2] = bounds.low[2] + axis.overlap;
  }
  if (bounds.is_empty()) return;
  bounds.grow(kMargin);
  Polytope box;
  make_box(bounds.axes, bounds.low, bounds.high, -1, box);
  std::array<Polytope, 2> scratch;
  Cutter cutter(box, scratch);
  if (cut(of_A, 0, bounds, cutter) && cut(of_B, 1, bounds, cutter)) {
    out = cutter.part();
  }
}

}  // namespace limber::contact
