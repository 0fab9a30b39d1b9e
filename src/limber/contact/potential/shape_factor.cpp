// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/potential/shape_factor.hpp"

#include <algorithm>
#include <cmath>

#include "limber/contact/potential/elliptic_integral.hpp"

namespace limber::contact {
namespace {

// Longer places count as this long [-].
constexpr double kMostElongation = 1e12;

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
  const EllipticIntegral integral = find_elliptic_integral(side);
  const double m = 1.0 - side * side;
  const double by_log_s = 0.5 - (1.0 - integral.defect - side * side) / m;
  const double log_u_by_log_s = 2.0 * (square - 1.0) / (square + 1.0);
  return {integral.mean / std::sqrt(side), by_log_s / log_u_by_log_s};
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
