// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace limber::testing {

/// The heavy symmetric top, released at a tilt with spin about its axis only:
/// it falls, precesses and nutates between two tilts, with a cusp at the upper
/// one.
///
/// Equation   u'^2 = beta (u - u1) (u - u2) (u - u3), u = cos(tilt), u1 <= u <=
///            u2 < u3;  u = u1 + (u2 - u1) cd^2(s t);  phi' = a (u2 - u) /
///            (1 - u^2)
/// Source     Goldstein, Classical Mechanics, sec. 5.7; the cubic as in
///            Jacobi's elliptic functions (Whittaker, Analytical Dynamics,
///            sec. 71).
class HeavyTop {
 public:
  /// @param I1 across, about the fixed point [kg m^2]; @param I3 along
  /// @param torque m g l [N m]; @param spin about the axis [rad/s]
  HeavyTop(double I1, double I3, double torque, double spin, double tilt);

  [[nodiscard]] double lowest_cosine() const { return low_; }
  /// From cusp to cusp [s].
  [[nodiscard]] double nutation_period() const;
  [[nodiscard]] double cosine(double t) const;
  /// Angle about the vertical from cusp to cusp [rad]: the rate is periodic and
  /// analytic, so that the trapezoidal rule is exact to roundoff.
  [[nodiscard]] double precession() const;

 private:
  double a_;  // [rad/s]
  double high_;
  double low_ = 0.0;
  double rate_ = 0.0;  // [1/s]
  double kc_ = 0.0;    // complementary modulus
};

}  // namespace limber::testing
