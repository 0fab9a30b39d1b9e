// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>

#include "limber/common/types.hpp"

namespace limber {

/// A number and its first two derivatives by a motion.
struct Jet {
  double value = 0.0;
  Vector6 slope = Vector6::Zero();
  Matrix6 bend = Matrix6::Zero();

  Jet() = default;
  Jet(double value_) : value(value_) {}  // NOLINT: a constant
  Jet(double value_, const Vector6& slope_, const Matrix6& bend_)
      : value(value_), slope(slope_), bend(bend_) {}

  /// f of this one. @param first, second its derivatives
  [[nodiscard]] Jet apply(double f, double first, double second) const {
    return {f, first * slope,
            first * bend + second * slope * slope.transpose()};
  }
  Jet& operator+=(const Jet& b) {
    value += b.value;
    slope += b.slope;
    bend += b.bend;
    return *this;
  }
};

inline Jet operator*(double c, const Jet& a) {
  return {c * a.value, c * a.slope, c * a.bend};
}
inline Jet operator-(const Jet& a) { return -1.0 * a; }
inline Jet operator+(Jet a, const Jet& b) { return a += b; }
inline Jet operator-(const Jet& a, const Jet& b) {
  return {a.value - b.value, a.slope - b.slope, a.bend - b.bend};
}
inline Jet operator*(const Jet& a, const Jet& b) {
  Matrix6 bend = a.slope * b.slope.transpose();
  bend += bend.transpose().eval();
  bend += a.value * b.bend + b.value * a.bend;
  return {a.value * b.value, a.value * b.slope + b.value * a.slope, bend};
}
inline Jet invert(const Jet& a) {
  const double f = 1.0 / a.value;
  return a.apply(f, -f * f, 2.0 * f * f * f);
}
inline Jet operator/(const Jet& a, const Jet& b) { return a * invert(b); }
inline Jet sqrt(const Jet& a) {
  const double f = std::sqrt(a.value);
  return a.apply(f, 0.5 / f, -0.25 / (f * a.value));
}

using JetVector = std::array<Jet, 3>;

inline JetVector make_jets(const Vector3& x) { return {x[0], x[1], x[2]}; }
inline JetVector operator+(const JetVector& a, const JetVector& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline JetVector operator-(const JetVector& a, const JetVector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline JetVector operator*(const Jet& c, const JetVector& a) {
  return {c * a[0], c * a[1], c * a[2]};
}
inline JetVector operator*(const Matrix3& R, const JetVector& a) {
  JetVector out;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      out[static_cast<std::size_t>(i)] +=
          R(i, j) * a[static_cast<std::size_t>(j)];
    }
  }
  return out;
}
inline Jet dot(const JetVector& a, const JetVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Jet dot(const Vector3& a, const JetVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline JetVector cross(const JetVector& a, const JetVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
          a[0] * b[1] - a[1] * b[0]};
}

/// x rotated by exp(sign theta) of a motion (u, theta).
inline JetVector apply_rotation(const JetVector& x, double sign) {
  JetVector theta;
  for (int i = 0; i < 3; ++i) {
    theta[static_cast<std::size_t>(i)].slope[3 + i] = sign;
  }
  const JetVector once = cross(theta, x);
  return x + once + Jet(0.5) * cross(theta, once);
}

/// Of a point at x from the place of a motion: exp(u, theta) x.
inline JetVector move(const Vector3& x) {
  JetVector u;
  JetVector theta;
  for (int i = 0; i < 3; ++i) {
    u[static_cast<std::size_t>(i)].slope[i] = 1.0;
    theta[static_cast<std::size_t>(i)].slope[3 + i] = 1.0;
  }
  return apply_rotation(make_jets(x), 1.0) + u + Jet(0.5) * cross(theta, u);
}

}  // namespace limber
