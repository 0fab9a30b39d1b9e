// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <numbers>

#include "support/free_top.hpp"

namespace limber::testing {

/// The heavy symmetric top, let go at a tilt with spin about its axis alone: it
/// falls, precesses and nutates between two tilts, with a cusp at the upper
/// one.
///
/// Equation   u'^2 = beta (u - u1) (u - u2) (u - u3), u = cos(tilt), u1 <= u <=
///            u2 < u3;  u = u1 + (u2 - u1) cd^2(s t);  phi' = a (u2 - u) /
///            (1 - u^2)
/// Source     Goldstein, Classical Mechanics, sec. 5.7; the cubic as in
/// Jacobi's
///            elliptic functions (Whittaker, Analytical Dynamics, sec. 71).
class HeavyTop {
 public:
  /// @param I1 across, about the fixed point [kg m^2]; @param I3 along
  /// @param torque m g l [N m]; @param spin about the axis [rad/s]
  HeavyTop(double I1, double I3, double torque, double spin, double tilt)
      : a_(I3 * spin / I1), high_(std::cos(tilt)) {
    const double beta = 2.0 * torque / I1;
    // What (u2 - u) leaves of the cubic: u^2 - p u + p u2 - 1 = 0.
    const double p = a_ * a_ / beta;
    const double root = std::sqrt(p * p - 4.0 * (p * high_ - 1.0));
    low_ = 0.5 * (p - root);
    const double beyond = 0.5 * (p + root);
    rate_ = 0.5 * std::sqrt(beta * (beyond - low_));
    kc_ = std::sqrt((beyond - high_) / (beyond - low_));
  }

  [[nodiscard]] double lowest_cosine() const { return low_; }
  /// From cusp to cusp [s].
  [[nodiscard]] double nutation_period() const {
    return 2.0 * complete_integral(kc_) / rate_;
  }
  [[nodiscard]] double cosine(double t) const {
    const double quarter = complete_integral(kc_);
    const double u = std::remainder(rate_ * t + quarter, 4.0 * quarter);
    const double sn = jacobi(u, kc_).sn;
    return low_ + (high_ - low_) * sn * sn;
  }
  /// Angle about the vertical from cusp to cusp [rad]: the rate is periodic and
  /// analytic, so that the trapezoidal rule is exact to roundoff.
  [[nodiscard]] double precession() const {
    constexpr int kPoints = 256;
    double sum = 0.0;
    for (int i = 0; i < kPoints; ++i) {
      const double u = cosine(nutation_period() * i / kPoints);
      sum += a_ * (high_ - u) / (1.0 - u * u);
    }
    return sum * nutation_period() / kPoints;
  }

 private:
  double a_;  // [rad/s]
  double high_;
  double low_ = 0.0;
  double rate_ = 0.0;  // [1/s]
  double kc_ = 0.0;    // complementary modulus
};

}  // namespace limber::testing
