// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/potential/depth_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>
#include <variant>

#include "limber/contact/shapes/cone_field.hpp"
#include "limber/contact/shapes/ellipsoid_field.hpp"
#include "limber/contact/shapes/line_cuts.hpp"

namespace limber::contact {
namespace {

double power4(double t) { return t * t * t * t; }

// ---- ball: phi = int 4 s^3 (R - s)^2 ds / (R - t)^2
Depth find_round(const Vector3& from_middle, double R) {
  const double rho = from_middle.norm();
  const double t = R - rho;
  const Vector3 gradient = -from_middle / rho;
  return {t, gradient,
          power4(t) * (R * R - 1.6 * R * t + (2.0 / 3.0) * t * t) /
              (rho * rho) * gradient};
}
Depth find(const Sphere& shape, const Vector3& x) {
  return find_round(x, shape.radius);
}
double find_t_of(const Sphere& shape, const Vector3& x) {
  return shape.radius - x.norm();
}
double deepest(const Sphere& /*shape*/, const StraightLine& line) {
  return clamp_to(line.span, find_nearest_v(line.origin, line.way));
}
Span part_within(const Sphere& shape, const StraightLine& line) {
  return intersect(line.span, find_chord(line.origin, line.way, shape.radius));
}
void split(const Sphere& /*shape*/, const StraightLine& /*line*/,
           const Span& part, LinePieces& out) {
  out.add() = {0, part.last};
}

// ---- side of a cylinder: phi = int 4 s^3 (R - s) ds / (R - t)
Depth find_side(const Vector3& x, double R) {
  const Vector3 out(x.x(), x.y(), 0.0);
  const double rho = out.norm();
  const double t = R - rho;
  const Vector3 gradient = -out / rho;
  return {t, gradient, power4(t) * (R - 0.8 * t) / rho * gradient};
}

// ---- capsule: its side and two balls
Depth find(const Capsule& shape, const Vector3& x) {
  const double end = std::clamp(x.z(), -shape.half_length, shape.half_length);
  if (end == x.z()) return find_side(x, shape.radius);
  return find_round(x - end * Vector3::UnitZ(), shape.radius);
}
double find_t_of(const Capsule& shape, const Vector3& x) {
  const double end = std::clamp(x.z(), -shape.half_length, shape.half_length);
  return shape.radius - (x - end * Vector3::UnitZ()).norm();
}
// Nearest to the axis: of the endless line, of it and the place clamped to the
// axis, then clamped to its own ends.
double deepest(const Capsule& shape, const StraightLine& line) {
  const Vector3& o = line.origin;
  const Vector3& w = line.way;
  const double v = find_nearest_v<Eigen::Vector2d>(o.head<2>(), w.head<2>());
  const double half = shape.half_length;
  const double on_axis = std::clamp(o.z() + v * w.z(), -half, half);
  return clamp_to(line.span,
                  find_nearest_v<Vector3>(o - on_axis * Vector3::UnitZ(), w));
}
Span part_within(const Capsule& shape, const StraightLine& line) {
  const Vector3& o = line.origin;
  const Vector3& w = line.way;
  Span all{kUnbounded, -kUnbounded};
  const auto unite = [&](const Span& part) {
    if (part.is_empty()) return;
    all = {std::min(all.first, part.first), std::max(all.last, part.last)};
  };
  unite(intersect(
      find_chord<Eigen::Vector2d>(o.head<2>(), w.head<2>(), shape.radius),
      find_slab(o.z(), w.z(), shape.half_length)));
  const Vector3 end = shape.half_length * Vector3::UnitZ();
  unite(find_chord<Vector3>(o - end, w, shape.radius));
  unite(find_chord<Vector3>(o + end, w, shape.radius));
  return intersect(line.span, all);
}
void split(const Capsule& shape, const StraightLine& line, const Span& part,
           LinePieces& out) {
  const Span side = find_slab(line.origin.z(), line.way.z(), shape.half_length);
  if (line.way.z() != 0.0) {
    for (const double v : {side.first, side.last}) {
      if (v > part.first && v < part.last) out.add() = {0, v};
    }
  }
  out.add() = {0, part.last};
}

// ---- cylinder: side 0, ends 1 and 2
Depth find(const Cylinder& shape, const Vector3& x) {
  const double end = shape.half_length - std::abs(x.z());
  if (shape.radius - x.head<2>().norm() <= end) {
    return find_side(x, shape.radius);
  }
  const Vector3 gradient = -std::copysign(1.0, x.z()) * Vector3::UnitZ();
  return {end, gradient, power4(end) * gradient};
}
double find_t_of(const Cylinder& shape, const Vector3& x) {
  return std::min(shape.radius - x.head<2>().norm(),
                  shape.half_length - std::abs(x.z()));
}
// Where side and end of the sign s are equally near.
std::array<double, 2> find_rim_crossings(const Cylinder& shape,
                                         const StraightLine& line, double s) {
  const Eigen::Vector2d o = line.origin.head<2>();
  const Eigen::Vector2d w = line.way.head<2>();
  const double p = shape.radius - shape.half_length + s * line.origin.z();
  const double m = s * line.way.z();  // rho = p + m v
  const double a = w.squaredNorm() - m * m;
  const double b = o.dot(w) - p * m;
  const double c = o.squaredNorm() - p * p;
  const double square = b * b - a * c;
  if (!(square >= 0.0)) return {kUnbounded, kUnbounded};
  const double q = -(b + std::copysign(std::sqrt(square), b));
  const auto keep = [&](double v) {
    return p + m * v >= 0.0 && s * (line.origin.z() + v * line.way.z()) >= 0.0
               ? v
               : kUnbounded;
  };
  return {a != 0.0 ? keep(q / a) : kUnbounded,
          q != 0.0 ? keep(c / q) : kUnbounded};
}
double deepest(const Cylinder& shape, const StraightLine& line) {
  const auto side = [&](double v) {
    return shape.radius - line.at(v).head<2>().norm();
  };
  const auto end = [&](double v) {
    return shape.half_length - std::abs(line.at(v).z());
  };
  const double v1 =
      clamp_to(line.span, find_nearest_v<Eigen::Vector2d>(line.origin.head<2>(),
                                                          line.way.head<2>()));
  if (side(v1) <= end(v1)) return v1;
  const double m = line.way.z();
  const double v2 = clamp_to(line.span, m != 0.0 ? -line.origin.z() / m : v1);
  if (end(v2) <= side(v2)) return v2;
  // Side falls and the ends' depth rises between them.
  double best = v1;
  double depth = end(v1);
  for (const double s : {-1.0, 1.0}) {
    for (const double v : find_rim_crossings(shape, line, s)) {
      if (!((v - v1) * (v - v2) <= 0.0)) continue;
      const double t = std::min(side(v), end(v));
      if (t > depth) {
        depth = t;
        best = v;
      }
    }
  }
  return best;
}
Span part_within(const Cylinder& shape, const StraightLine& line) {
  return intersect(
      line.span,
      intersect(find_chord<Eigen::Vector2d>(line.origin.head<2>(),
                                            line.way.head<2>(), shape.radius),
                find_slab(line.origin.z(), line.way.z(), shape.half_length)));
}
int name_face(const Cylinder& shape, const Vector3& x) {
  const double end = shape.half_length - std::abs(x.z());
  if (shape.radius - x.head<2>().norm() <= end) return 0;
  return x.z() > 0.0 ? 1 : 2;
}
void split(const Cylinder& shape, const StraightLine& line, const Span& part,
           LinePieces& out) {
  std::array<double, 6> ends;
  std::size_t count = 0;
  for (const double s : {-1.0, 1.0}) {
    for (const double v : find_rim_crossings(shape, line, s)) {
      if (v > part.first && v < part.last) ends[count++] = v;
    }
  }
  ends[count++] = part.last;
  std::sort(ends.begin(), ends.begin() + static_cast<std::ptrdiff_t>(count));
  double first = part.first;
  for (std::size_t i = 0; i < count; ++i) {
    if (i + 1 < count && ends[i] == first) continue;
    out.add() = {name_face(shape, line.at(0.5 * (first + ends[i]))), ends[i]};
    first = ends[i];
  }
}

// ---- n . x from -w to w
double find_half_width(const Sphere& shape, const Vector3& /*n*/) {
  return shape.radius;
}
double find_half_width(const Capsule& shape, const Vector3& n) {
  return shape.radius + shape.half_length * std::abs(n.z());
}
double find_half_width(const Cylinder& shape, const Vector3& n) {
  return shape.radius * n.head<2>().norm() +
         shape.half_length * std::abs(n.z());
}

// ---- cone and ellipsoid
double deepest(const Cone& shape, const StraightLine& line) {
  return ConeField(shape).find_deepest(line);
}
Span part_within(const Cone& shape, const StraightLine& line) {
  return ConeField(shape).cut(line);
}
void split(const Cone& shape, const StraightLine& line, const Span& part,
           LinePieces& out) {
  ConeField(shape).divide(line, part, out);
}
double deepest(const Ellipsoid& shape, const StraightLine& line) {
  return EllipsoidField(shape).find_deepest(line);
}
Span part_within(const Ellipsoid& shape, const StraightLine& line) {
  return EllipsoidField(shape).cut(line);
}
void split(const Ellipsoid& /*shape*/, const StraightLine& /*line*/,
           const Span& part, LinePieces& out) {
  out.add() = {0, part.last};
}
double find_half_width(const Ellipsoid& shape, const Vector3& n) {
  return shape.radii.cwiseProduct(n).norm();
}

// ---- as the round ones
Depth find_of(const SolidField& solid, const Vector3& x, int face,
              bool /*by_tip*/) {
  return solid.find_depth(x, face);
}
Depth find_of(const Cone& shape, const Vector3& x, int /*face*/, bool by_tip) {
  return ConeField(shape).find_depth(x, by_tip);
}
Depth find_of(const Ellipsoid& shape, const Vector3& x, int /*face*/,
              bool /*by_tip*/) {
  return EllipsoidField(shape).find_depth(x);
}
template <typename Round>
Depth find_of(const Round& shape, const Vector3& x, int /*face*/,
              bool /*by_tip*/) {
  return find(shape, x);
}
double deepest(const SolidField& solid, const StraightLine& line) {
  return solid.find_deepest(line);
}
Span part_within(const SolidField& solid, const StraightLine& line) {
  return solid.cut(line);
}
void split(const SolidField& solid, const StraightLine& line, const Span& part,
           LinePieces& out) {
  solid.divide(line, part, out);
}
double find_t_of(const SolidField& solid, const Vector3& x) {
  return solid.find_t(x);
}
double find_t_of(const Cone& shape, const Vector3& x) {
  return ConeField(shape).find_t(x);
}
double find_t_of(const Ellipsoid& shape, const Vector3& x) {
  return EllipsoidField(shape).find_bound(x);
}
Span find_extent_of(const SolidField& field, const Vector3& n) {
  const ConvexSolid& solid = field.solid();
  if (!solid.is_bounded()) return {-kUnbounded, kUnbounded};
  return {solid.find_low(n), solid.find_high(n)};
}
Span find_extent_of(const Cone& shape, const Vector3& n) {
  const double tip = n.z() * shape.half_length;
  const double rim = shape.radius * n.head<2>().norm();
  return {std::min(tip, -tip - rim), std::max(tip, -tip + rim)};
}
template <typename Round>
Span find_extent_of(const Round& shape, const Vector3& n) {
  const double w = find_half_width(shape, n);
  return {-w, w};
}

DepthField::Kind make_field(const BodyKind& body) {
  return std::visit(
      [](const auto& shape) -> DepthField::Kind {
        if constexpr (std::is_same_v<std::decay_t<decltype(shape)>,
                                     ConvexSolid>) {
          return SolidField(shape);
        } else {
          return shape;
        }
      },
      body);
}

}  // namespace

DepthField::DepthField(const BodyKind& body) : kind_(make_field(body)) {}

bool DepthField::is_flat() const {
  return std::holds_alternative<SolidField>(kind_);
}

double DepthField::find_t(const Vector3& x) const {
  return std::visit([&](const auto& shape) { return find_t_of(shape, x); },
                    kind_);
}

Depth DepthField::find_depth(const Vector3& x, int face, bool by_tip) const {
  return std::visit(
      [&](const auto& shape) { return find_of(shape, x, face, by_tip); },
      kind_);
}

double DepthField::find_deepest(const StraightLine& line) const {
  return std::visit([&](const auto& shape) { return deepest(shape, line); },
                    kind_);
}

Span DepthField::cut(const StraightLine& line) const {
  return std::visit([&](const auto& shape) { return part_within(shape, line); },
                    kind_);
}

void DepthField::divide(const StraightLine& line, const Span& part,
                        LinePieces& out) const {
  std::visit([&](const auto& shape) { split(shape, line, part, out); }, kind_);
}

Span DepthField::find_extent(const Vector3& n) const {
  return std::visit([&](const auto& shape) { return find_extent_of(shape, n); },
                    kind_);
}

}  // namespace limber::contact
