// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/potential/ruled_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "limber/contact/potential/line_rule.hpp"

namespace limber::contact {
namespace {

using Kind = RuledSurface::Kind;
using Vector2 = Eigen::Vector2d;

Vector3 find_radial(const RuledSurface& surface, double u) {
  return std::cos(u) * surface.e1 + std::sin(u) * surface.e2;
}

double find_cosine(const RuledSurface& surface) {
  return std::sqrt(1.0 - surface.sine * surface.sine);
}

StraightLine find_side_line(const RuledSurface& side, const Vector3& radial) {
  return {side.centre + side.radius * radial,
          find_cosine(side) * side.e3 - side.sine * radial,
          {-side.half_v, side.half_v}};
}

// cot(b / 2) = (1 + cos b) / sin b
double find_rim_slope(const RuledSurface& rim) {
  return (1.0 + rim.sine) / find_cosine(rim);
}

// Of corners along the axes of the outline, in those of the rows.
Vector2 turn_corner(const Vector2& x, const Vector2& row) {
  return {x[0] * row[1] - x[1] * row[0], x.dot(row)};
}

Span find_range(FlatOutline outline, const Vector2& row) {
  Span range{std::numeric_limits<double>::max(),
             std::numeric_limits<double>::lowest()};
  for (const Vector2& x : outline) {
    const double u = turn_corner(x, row)[0];
    range = {std::min(range.first, u), std::max(range.last, u)};
  }
  return range;
}

// @param use (corner, next corner)
template <typename Use>
void visit_edges(const RuledSurface& surface, const Use& use) {
  const std::size_t count = surface.outline.size();
  Vector2 from = surface.find_corner(count - 1);
  for (std::size_t i = 0; i < count; ++i) {
    const Vector2 to = surface.find_corner(i);
    use(from, to);
    from = to;
  }
}

StraightLine find_row(const RuledSurface& polygon, double u) {
  const double at = std::clamp(u, polygon.u.first, polygon.u.last);
  Span span{std::numeric_limits<double>::max(),
            std::numeric_limits<double>::lowest()};
  visit_edges(polygon, [&](const Vector2& a, const Vector2& b) {
    if ((a[0] - at) * (b[0] - at) > 0.0 || a[0] == b[0]) return;
    const double v = a[1] + (b[1] - a[1]) * ((at - a[0]) / (b[0] - a[0]));
    span = {std::min(span.first, v), std::max(span.last, v)};
  });
  return {polygon.centre + at * polygon.e1, polygon.e2, span};
}

// A way for rows, in the axes of the outline: of the longest edge if `way` is
// zero, and of an edge that is nearly along it, beside which rows would be cut
// all at once.
Vector2 choose_row(FlatOutline outline, const Vector2& way) {
  constexpr double kAlong = 0.05;  // [rad]
  constexpr double kLonger = 1.0 + 1e-9;
  Vector2 longest = Vector2::Zero();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector2 edge = outline[(i + 1) % outline.size()] - outline[i];
    const double length = edge.norm();
    const double across = way[0] * edge[1] - way[1] * edge[0];
    if (std::abs(across) > kAlong * length) continue;
    if (length > kLonger * longest.norm()) longest = edge;
  }
  return longest.isZero(0.0) ? way : Vector2(longest.normalized());
}

// int t^4 dv of t = depth + slope v
double integrate_power(const RuledSurface& sheet, const Span& span) {
  const auto& rule = line_rule<3>();
  double sum = 0.0;
  for (std::size_t i = 0; i < rule.places.size(); ++i) {
    const double v = span.first + rule.places[i] * span.length();
    const double square = std::pow(sheet.depth + sheet.slope * v, 2);
    sum += rule.weights[i] * square * square;
  }
  return sum * span.length();
}

}  // namespace

Vector2 RuledSurface::find_corner(std::size_t i) const {
  return turn_corner(outline[i], row);
}

StraightLine RuledSurface::find_line(double at) const {
  switch (kind) {
    case Kind::kPlane:
      return {centre + at * e1, e2, {-half_v, half_v}};
    case Kind::kPolygon:
      return find_row(*this, at);
    case Kind::kDisc: {
      const double half = radius * std::cos(at);
      return {centre + radius * std::sin(at) * e1, e2, {-half, half}};
    }
    case Kind::kSide:
      return find_side_line(*this, find_radial(*this, at));
    case Kind::kRim:
      break;
  }
  const Vector3 radial = find_radial(*this, at);
  return {centre + radius * radial,
          -find_rim_slope(*this) * radial - e3,
          {0.0, half_v}};
}

Vector3 RuledSurface::find_area(double at) const {
  if (is_flat()) return e3;
  return radius * std::cos(at) * e3;
}

StraightLine RuledSurface::find_line(double at, Vector3& area) const {
  const Vector3 radial = find_radial(*this, at);
  area = radius * (find_cosine(*this) * radial + sine * e3);
  return find_side_line(*this, radial);
}

// Rim, R - t k in radius, dS = (R - t k) du dv / sin(b / 2), k = cot(b / 2), b
// its angle, 90 degrees of a cylinder: of the end t^4 cos(b / 2), of the side
// t^4 (1 + 0.2 t cos a / (R - t k)) cos(b / 2), by tip 2/3 t^3 l sin(b / 2), l
// from the rim to the tip.
double RuledSurface::find_flux(const Span& span, bool by_tip) const {
  if (kind != Kind::kRim) return density * integrate_power(*this, span);
  const double k = find_rim_slope(*this);
  const auto integral = [&](double v) {
    const double of_end = k * (radius / 5.0 - k * v / 6.0) * std::pow(v, 5);
    if (!by_tip) {
      return 2.0 * of_end + k * find_cosine(*this) / 30.0 * std::pow(v, 6);
    }
    const double slant = radius / sine;
    return of_end +
           2.0 / 3.0 * slant * (radius / 4.0 - k * v / 5.0) * std::pow(v, 4);
  };
  return integral(span.last) - integral(span.first);
}

double RuledSurface::find_speed() const {
  if (kind == Kind::kPlane) return 1.0;
  if (narrows()) return 2.0 * radius;  // of the disc
  if (kind != Kind::kPolygon) return radius;
  constexpr double kSteep = 1e-9;  // of an edge along the rows [-]
  double steepest = 0.0;
  visit_edges(*this, [&](const Vector2& a, const Vector2& b) {
    const Vector2 edge = (b - a).cwiseAbs();
    if (edge[0] > kSteep * edge[1])
      steepest = std::max(steepest, edge[1] / edge[0]);
  });
  return std::hypot(1.0, steepest);
}

RuledSurface RuledSurface::place(const Pose& X) const {
  RuledSurface placed = *this;
  placed.centre = X * centre;
  placed.e1 = X.R * e1;
  placed.e2 = X.R * e2;
  placed.e3 = X.R * e3;
  return placed;
}

void RuledSurface::turn_rows(const Vector3& way) {
  if (is_closed()) return;
  if (kind != Kind::kPolygon) {
    e2 = way.isZero(0.0) ? Vector3(e3.unitOrthogonal()) : way;
    e1 = e2.cross(e3);
    return;
  }
  // Of the outline's axes, by the present row.
  const Vector3 x = row[1] * e1 + row[0] * e2;
  const Vector3 y = -row[0] * e1 + row[1] * e2;
  row = choose_row(outline, {way.dot(x), way.dot(y)});
  e2 = row[0] * x + row[1] * y;
  e1 = e2.cross(e3);
  u = find_range(outline, row);
}

RuledSurface make_polygon(std::span<const Vector3> corners,
                          const Vector3& normal, const Vector3& way,
                          std::vector<Vector2>& outline) {
  RuledSurface polygon;
  polygon.kind = Kind::kPolygon;
  polygon.e3 = normal;
  polygon.e2 = way;
  polygon.e1 = way.cross(normal);
  for (const Vector3& x : corners) polygon.centre += x;
  polygon.centre /= static_cast<double>(corners.size());
  for (const Vector3& x : corners) {
    const Vector3 r = x - polygon.centre;
    outline.emplace_back(r.dot(polygon.e1), r.dot(polygon.e2));
    polygon.reach = std::max(polygon.reach, r.norm());
  }
  polygon.outline = outline;
  polygon.u = find_range(polygon.outline, polygon.row);
  return polygon;
}

}  // namespace limber::contact
