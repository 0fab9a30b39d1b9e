// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/shapes/ellipsoid_field.hpp"

#include <cmath>

namespace limber::contact {
namespace {

// s of the nearest point, from below, where 1 / sqrt(F), concave, is < 1.
double find_shift(const Vector3& squares, const Vector3& scaled) {
  constexpr int kMostIterations = 50;
  double s = (scaled.cwiseAbs() - squares).maxCoeff();
  for (int i = 0; i < kMostIterations; ++i) {
    const Vector3 below = squares.array() + s;
    const Vector3 terms = scaled.cwiseQuotient(below);
    const double F = terms.squaredNorm();
    const double slope = terms.cwiseAbs2().cwiseQuotient(below).sum();
    // (1 / sqrt(F))' = slope / F^1.5
    const double change = (F * std::sqrt(F) - F) / slope;
    if (!(change > 1e-16 * squares.maxCoeff())) break;
    s += change;
  }
  return s;
}

}  // namespace

Depth EllipsoidField::find_depth(const Vector3& x) const {
  const Vector3 squares = radii_.cwiseAbs2();
  const double s = find_shift(squares, radii_.cwiseProduct(x));
  const Vector3 out = x.array() / (squares.array() + s);  // y_i / r_i^2
  const Vector3 y = squares.cwiseProduct(out);
  const double square = out.squaredNorm();
  const double length = std::sqrt(square);
  const double t = -s * length;
  const double volume = squares.prod();
  const double H =
      (squares.sum() - y.squaredNorm()) / (2.0 * volume * square * length);
  const double K = 1.0 / (volume * square * square);
  const double phi = t * t * t * t *
                     (1.0 - 1.6 * H * t + (2.0 / 3.0) * K * t * t) /
                     (1.0 - 2.0 * H * t + K * t * t);
  const Vector3 gradient = -out / length;
  return {t, gradient, phi * gradient};
}

double EllipsoidField::find_deepest(const StraightLine& line) const {
  return clamp_to(line.span,
                  find_nearest_v<Vector3>(inverse_.cwiseProduct(line.origin),
                                          inverse_.cwiseProduct(line.way)));
}

Span EllipsoidField::cut(const StraightLine& line) const {
  return intersect(line.span,
                   find_chord<Vector3>(inverse_.cwiseProduct(line.origin),
                                       inverse_.cwiseProduct(line.way), 1.0));
}

}  // namespace limber::contact
