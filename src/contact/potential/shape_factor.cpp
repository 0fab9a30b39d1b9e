// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/potential/shape_factor.hpp"

#include <algorithm>
#include <cmath>

namespace limber::contact {
namespace {

// Longer places count as this long [-].
constexpr double kMostElongation = 1e12;

struct Ellipse {
  double mean = 1.0;   // of 1 and k', arithmetic-geometric: K = pi / (2 mean)
  double ratio = 1.0;  // E / K
};

// @param side k' in (0, 1)
Ellipse find_ellipse(double side) {
  double a = 1.0;
  double b = side;
  double power = 0.5;
  double sum = power * (1.0 - side * side);
  while (a - b > 1e-15 * a) {
    const double c = 0.5 * (a - b);
    const double next = 0.5 * (a + b);
    b = std::sqrt(a * b);
    a = next;
    power *= 2.0;
    sum += power * c * c;
  }
  return {a, 1.0 - sum};
}

}  // namespace

Factor Factor::operator*(const Factor& other) const {
  return {value * other.value, rate + other.rate,
          second + other.second + rate * other.rate.transpose() +
              other.rate * rate.transpose()};
}

Factor Factor::transform(const Matrix6& T) const {
  return {value, T * rate, T * second * T.transpose()};
}

ShapeFactor find_shape_factor(double u) {
  // phi = 1 + (u - 1) / 16 next to a circle
  constexpr double kRound = 1e-5;
  if (!(u > 1.0 + kRound)) {
    const double over = std::max(u - 1.0, 0.0) / 16.0;
    return {1.0 + over, 1.0 / 16.0};
  }
  const double b = 2.0 * std::min(u, kMostElongation) - 1.0;
  const double square = b + std::sqrt(b * b - 1.0);  // s^2
  const double side = 1.0 / std::sqrt(square);       // k'
  const Ellipse ellipse = find_ellipse(side);
  const double m = 1.0 - side * side;
  const double by_log_s = 0.5 - (ellipse.ratio - side * side) / m;
  const double log_u_by_log_s = 2.0 * (square - 1.0) / (square + 1.0);
  return {ellipse.mean / std::sqrt(side), by_log_s / log_u_by_log_s};
}

Elongation find_elongation(const Matrix3& S, const Vector3& n) {
  const Vector3 Sn = S * n;
  const double along = n.dot(Sn);
  const double trace = S.trace();
  const double in_plane = trace - along;
  // n . adj(S) n
  const double det = Sn.squaredNorm() - trace * along +
                     0.5 * (trace * trace - S.squaredNorm());
  Elongation out;
  out.u = in_plane * in_plane / (4.0 * det);
  if (!(det > 0.0) || !(out.u < kMostElongation)) {
    out.u = kMostElongation;
    return out;
  }
  const Matrix3 plane = Matrix3::Identity() - n * n.transpose();
  const Matrix3 by_det =
      n * Sn.transpose() + Sn * n.transpose() - along * Matrix3::Identity() -
      trace * n * n.transpose() + trace * Matrix3::Identity() - S;
  out.by_moments = (2.0 / in_plane) * plane - by_det / det;
  return out;
}

}  // namespace limber::contact
