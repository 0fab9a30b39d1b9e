// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "limber/contact/shapes/straight_line.hpp"

/// Parts of straight lines o + v w.
namespace limber::contact {

inline constexpr double kUnbounded = std::numeric_limits<double>::max();

inline Span intersect(const Span& a, const Span& b) {
  return {std::max(a.first, b.first), std::min(a.last, b.last)};
}

// |p + v m| <= h
inline Span find_slab(double p, double m, double h) {
  if (m == 0.0)
    return std::abs(p) <= h ? Span{-kUnbounded, kUnbounded} : Span{};
  const double middle = -p / m;
  const double half = h / std::abs(m);
  return {middle - half, middle + half};
}

// |o + v w| <= R, of vectors of two or three components
template <typename Vector>
Span find_chord(const Vector& o, const Vector& w, double radius) {
  const double a = w.squaredNorm();
  if (!(a > 0.0)) {
    return o.norm() <= radius ? Span{-kUnbounded, kUnbounded} : Span{};
  }
  const double middle = -o.dot(w) / a;
  const double square = radius * radius - (o + middle * w).squaredNorm();
  if (!(square > 0.0)) return {};
  const double half = std::sqrt(square / a);
  return {middle - half, middle + half};
}

// v of the least |o + v w|
template <typename Vector>
double find_nearest_v(const Vector& o, const Vector& w) {
  const double a = w.squaredNorm();
  return a > 0.0 ? -o.dot(w) / a : 0.0;
}

inline double clamp_to(const Span& span, double v) {
  return std::clamp(v, span.first, span.last);
}

}  // namespace limber::contact
