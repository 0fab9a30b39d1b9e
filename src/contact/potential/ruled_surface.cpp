// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/potential/ruled_surface.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

#include "limber/common/errors.hpp"

namespace limber::contact {
namespace {

using Kind = RuledSurface::Kind;

// Directions more upright than this have none in the plane [-].
constexpr double kUpright = 1e-6;
// More than a soft body's extent [-].
constexpr double kMargin = 1.01;

Vector3 find_radial(const RuledSurface& surface, double u) {
  return std::cos(u) * surface.e1 + std::sin(u) * surface.e2;
}

// In the soft body's frame.
Vector3 choose_way(const ShapeKind& soft, const Vector3& n) {
  if (std::holds_alternative<HalfSpace>(soft)) {
    return n.cross(Vector3::UnitZ());
  }
  if (std::holds_alternative<Box>(soft)) {
    Eigen::Index axis = 0;
    n.cwiseAbs().minCoeff(&axis);
    return Vector3::Unit(axis);
  }
  if (std::holds_alternative<Sphere>(soft)) return Vector3::Zero();
  return Vector3::UnitZ();
}

Vector3 find_row_way(const ShapeKind& soft, const Vector3& n) {
  const Vector3 way = choose_way(soft, n);
  const Vector3 in_plane = way - way.dot(n) * n;
  if (in_plane.norm() < kUpright) return n.unitOrthogonal();
  return in_plane.normalized();
}

double find_radius(const ShapeKind& shape) {
  if (const auto* ball = std::get_if<Sphere>(&shape)) return ball->radius;
  if (const auto* box = std::get_if<Box>(&shape)) return box->half_size.norm();
  if (const auto* rod = std::get_if<Capsule>(&shape)) {
    return rod->half_length + rod->radius;
  }
  const auto* cylinder = std::get_if<Cylinder>(&shape);
  LIMBER_EXPECT(cylinder != nullptr);
  return std::hypot(cylinder->half_length, cylinder->radius);
}

void list(const HalfSpace& /*shape*/, const Pose& X, const ShapeKind& soft,
          RuledSurfaces& out) {
  RuledSurface& plane = out.add();
  plane.e3 = X.R.col(2);
  plane.e2 = find_row_way(soft, plane.e3);
  plane.e1 = plane.e2.cross(plane.e3);
  plane.centre = X.p.dot(plane.e3) * plane.e3;
  plane.half_u = kMargin * find_radius(soft);
  plane.half_v = plane.half_u;
}

void list(const Box& shape, const Pose& X, const ShapeKind& soft,
          RuledSurfaces& out) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      RuledSurface& face = out.add();
      face.e3 = sign * X.R.col(axis);
      face.centre = X.p + shape.half_size[axis] * face.e3;
      const Vector3 way = find_row_way(soft, face.e3);
      int u = (axis + 1) % 3;
      int v = (axis + 2) % 3;
      if (std::abs(way.dot(X.R.col(u))) > std::abs(way.dot(X.R.col(v)))) {
        std::swap(u, v);
      }
      face.e1 = X.R.col(u);
      face.e2 = X.R.col(v);
      face.half_u = shape.half_size[u];
      face.half_v = shape.half_size[v];
    }
  }
}

void list(const Cylinder& shape, const Pose& X, const ShapeKind& soft,
          RuledSurfaces& out) {
  RuledSurface& side = out.add();
  side.kind = Kind::kSide;
  side.centre = X.p;
  side.e1 = X.R.col(0);
  side.e2 = X.R.col(1);
  side.e3 = X.R.col(2);
  side.radius = shape.radius;
  side.half_u = std::numbers::pi;
  side.half_v = shape.half_length;
  for (const double sign : {-1.0, 1.0}) {
    RuledSurface& disc = out.add();
    disc.kind = Kind::kDisc;
    disc.e3 = sign * X.R.col(2);
    disc.centre = X.p + shape.half_length * disc.e3;
    disc.e2 = find_row_way(soft, disc.e3);
    disc.e1 = disc.e2.cross(disc.e3);
    disc.radius = shape.radius;
    disc.half_u = 0.5 * std::numbers::pi;
  }
}

template <typename Other>
void list(const Other& /*shape*/, const Pose& /*X*/, const ShapeKind& /*soft*/,
          RuledSurfaces& /*out*/) {
  LIMBER_EXPECT(!"a surface of straight lines");
}

void list_rims(const Cylinder& shape, RuledSurfaces& out) {
  for (const double sign : {-1.0, 1.0}) {
    RuledSurface& rim = out.add();
    rim.kind = Kind::kRim;
    rim.e3 = sign * Vector3::UnitZ();
    rim.centre = shape.half_length * rim.e3;
    rim.radius = shape.radius;
    rim.half_u = std::numbers::pi;
    rim.half_v = std::min(shape.radius, shape.half_length);
  }
}

void list_ridges(const Box& shape, RuledSurfaces& out) {
  const Vector3& h = shape.half_size;
  for (int axis = 0; axis < 3; ++axis) {
    const int i = (axis + 1) % 3;
    const int j = (axis + 2) % 3;
    for (const double a : {-1.0, 1.0}) {
      for (const double b : {-1.0, 1.0}) {
        RuledSurface& ridge = out.add();
        ridge.kind = Kind::kRidge;
        ridge.e1 = Vector3::Unit(axis);
        ridge.e2 = -a * Vector3::Unit(i) - b * Vector3::Unit(j);
        ridge.centre =
            a * h[i] * Vector3::Unit(i) + b * h[j] * Vector3::Unit(j);
        ridge.half_u = h[axis];
        ridge.half_v = std::min(h[i], h[j]);
      }
    }
  }
}

}  // namespace

StraightLine RuledSurface::find_line(double u) const {
  switch (kind) {
    case Kind::kFlat:
      return {centre + u * e1, e2, {-half_v, half_v}};
    case Kind::kDisc: {
      const double half = radius * std::cos(u);
      return {centre + radius * std::sin(u) * e1, e2, {-half, half}};
    }
    case Kind::kSide:
      return {centre + radius * find_radial(*this, u), e3, {-half_v, half_v}};
    case Kind::kRidge:
      return {centre + u * e1,
              e2,
              {0.0, std::min(half_v, std::max(half_u - std::abs(u), 0.0))}};
    case Kind::kRim:
      break;
  }
  const Vector3 radial = find_radial(*this, u);
  return {centre + radius * radial, -radial - e3, {0.0, half_v}};
}

Vector3 RuledSurface::find_area(double u) const {
  if (kind == Kind::kFlat) return e3;
  if (kind == Kind::kDisc) return radius * std::cos(u) * e3;
  return radius * find_radial(*this, u);
}

// Ridge: both t^4 / sqrt(2), dS = sqrt(2) du dv. Rim: side
// t^4 (R - 0.8 t) / (R - t), end t^4, dS = sqrt(2) (R - t) du dv.
double RuledSurface::find_flux(const Span& span) const {
  const auto integral = [&](double v) {
    const double fifth = std::pow(v, 5);
    return kind == Kind::kRidge ? 0.4 * fifth
                                : (0.4 * radius - 0.3 * v) * fifth;
  };
  return integral(span.last) - integral(span.first);
}

double RuledSurface::find_speed() const {
  if (kind == Kind::kFlat) return 1.0;
  return kind == Kind::kRidge ? 2.0 : radius;
}

double RuledSurface::find_reach() const {
  switch (kind) {
    case Kind::kFlat:
      return std::hypot(half_u, half_v);
    case Kind::kDisc:
      return radius;
    case Kind::kRidge:
      return std::hypot(half_u, std::numbers::sqrt2 * half_v);
    default:
      return std::hypot(radius, half_v);
  }
}

RuledSurface RuledSurface::place(const Pose& X) const {
  RuledSurface placed = *this;
  placed.centre = X * centre;
  placed.e1 = X.R * e1;
  placed.e2 = X.R * e2;
  placed.e3 = X.R * e3;
  return placed;
}

void list_surfaces(const ShapeKind& hard, const Pose& X, const ShapeKind& soft,
                   RuledSurfaces& out) {
  std::visit([&](const auto& shape) { list(shape, X, soft, out); }, hard);
}

void list_sheets(const ShapeKind& soft, RuledSurfaces& out) {
  if (const auto* box = std::get_if<Box>(&soft)) list_ridges(*box, out);
  if (const auto* cylinder = std::get_if<Cylinder>(&soft)) {
    list_rims(*cylinder, out);
  }
}

}  // namespace limber::contact
