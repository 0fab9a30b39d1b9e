// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/shapes/cone_field.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace limber::contact {
namespace {

using Vector2 = Eigen::Vector2d;

// v of a v^2 + 2 b v + c = 0; kUnbounded where there is none.
std::array<double, 2> solve_square(double a, double b, double c) {
  const double square = b * b - a * c;
  if (!(square >= 0.0)) return {kUnbounded, kUnbounded};
  const double q = -(b + std::copysign(std::sqrt(square), b));
  return {a != 0.0 ? q / a : kUnbounded, q != 0.0 ? c / q : kUnbounded};
}

}  // namespace

ConeField::ConeField(const Cone& shape) : half_length_(shape.half_length) {
  const double slant = std::hypot(shape.radius, 2.0 * shape.half_length);
  sine_ = shape.radius / slant;
  cosine_ = 2.0 * shape.half_length / slant;
}

double ConeField::find_side(const Vector3& x) const {
  return (half_length_ - x.z()) * sine_ - x.head<2>().norm() * cosine_;
}

double ConeField::find_end(const Vector3& x) const {
  return half_length_ + x.z();
}

double ConeField::find_t(const Vector3& x) const {
  return std::min(find_side(x), find_end(x));
}

Depth ConeField::find_depth(const Vector3& x, bool by_tip) const {
  const double end = find_end(x);
  const double t = find_side(x);
  if (end < t) {
    return {end, Vector3::UnitZ(), end * end * end * end * Vector3::UnitZ()};
  }
  const double rho = x.head<2>().norm();
  Vector3 gradient(0.0, 0.0, -sine_);
  if (rho > 0.0) gradient.head<2>() = -cosine_ / rho * x.head<2>();
  const double cube = t * t * t;
  if (by_tip) {
    return {t, gradient,
            2.0 / 3.0 * cube * (x - half_length_ * Vector3::UnitZ())};
  }
  return {t, gradient, cube * t * (rho + 0.2 * t * cosine_) / rho * gradient};
}

std::array<double, 2> ConeField::find_rim_crossings(
    const StraightLine& line) const {
  const Vector2 o = line.origin.head<2>();
  const Vector2 w = line.way.head<2>();
  // cos a rho = p + m v
  const double p =
      half_length_ * (sine_ - 1.0) - (1.0 + sine_) * line.origin.z();
  const double m = -(1.0 + sine_) * line.way.z();
  const double square = cosine_ * cosine_;
  auto found =
      solve_square(square * w.squaredNorm() - m * m, square * o.dot(w) - p * m,
                   square * o.squaredNorm() - p * p);
  for (double& v : found) {
    if (!(p + m * v >= 0.0)) v = kUnbounded;
  }
  return found;
}

double ConeField::find_deepest(const StraightLine& line) const {
  const Vector2 o = line.origin.head<2>();
  const Vector2 w = line.way.head<2>();
  const auto side = [&](double v) { return find_side(line.at(v)); };
  const auto end = [&](double v) { return find_end(line.at(v)); };
  // d rho / dv where the side's depth is largest
  const double slope = -line.way.z() * sine_ / cosine_;
  const double steepest = w.norm();
  double v1 = slope > 0.0 ? line.span.last : line.span.first;
  if (std::abs(slope) < steepest) {
    const double middle = find_nearest_v<Vector2>(o, w);
    const double rho = (o + middle * w).norm();
    v1 = clamp_to(line.span,
                  middle + rho * slope /
                               (steepest * std::sqrt(steepest * steepest -
                                                     slope * slope)));
  }
  if (side(v1) <= end(v1)) return v1;
  const double v2 = line.way.z() == 0.0  ? v1
                    : line.way.z() > 0.0 ? line.span.last
                                         : line.span.first;
  if (end(v2) <= side(v2)) return v2;
  // Side falls and the disc's depth rises between them.
  double best = v1;
  double depth = end(v1);
  for (const double v : find_rim_crossings(line)) {
    if (!((v - v1) * (v - v2) <= 0.0)) continue;
    const double t = find_t(line.at(v));
    if (t > depth) {
      depth = t;
      best = v;
    }
  }
  return best;
}

Span ConeField::cut(const StraightLine& line) const {
  const Vector2 o = line.origin.head<2>();
  const Vector2 w = line.way.head<2>();
  Span part = intersect(line.span,
                        find_slab(line.origin.z(), line.way.z(), half_length_));
  if (part.is_empty()) return {};
  // (h - z)^2 sin^2 a >= rho^2 cos^2 a, of both halves, of which z <= h has one
  const double p = (half_length_ - line.origin.z()) * sine_;
  const double m = -line.way.z() * sine_;
  const double square = cosine_ * cosine_;
  const double a = m * m - square * w.squaredNorm();
  auto [first, last] = solve_square(a, p * m - square * o.dot(w),
                                    p * p - square * o.squaredNorm());
  if (first == kUnbounded && last == kUnbounded) {
    if (!(a > 0.0)) return {};
    first = last = (square * o.dot(w) - p * m) / a;  // through the tip
  }
  if (first > last) std::swap(first, last);
  if (a < 0.0) return intersect(part, {first, last});
  // Towards the disc from the crossing that is nearer to it.
  return intersect(
      part, m < 0.0 ? Span{-kUnbounded, first}
                    : Span{last == kUnbounded ? first : last, kUnbounded});
}

void ConeField::divide(const StraightLine& line, const Span& part,
                       LinePieces& out) const {
  const Vector2 o = line.origin.head<2>();
  const Vector2 w = line.way.head<2>();
  std::array<double, 4> ends;
  std::size_t count = 0;
  const auto add = [&](double v) {
    if (v > part.first && v < part.last) ends[count++] = v;
  };
  for (const double v : find_rim_crossings(line)) add(v);
  add(find_nearest_v<Vector2>(o, w));
  ends[count++] = part.last;
  std::sort(ends.begin(), ends.begin() + static_cast<std::ptrdiff_t>(count));
  const int side = o.x() * w.y() - o.y() * w.x() > 0.0 ? 1 : 2;
  double first = part.first;
  for (std::size_t i = 0; i < count; ++i) {
    if (i + 1 < count && ends[i] == first) continue;
    const Vector3 x = line.at(0.5 * (first + ends[i]));
    out.add() = {find_end(x) < find_side(x) ? 0 : side, ends[i]};
    first = ends[i];
  }
}

}  // namespace limber::contact
