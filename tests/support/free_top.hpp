// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/types.hpp"

namespace limber::testing {

/// sn, cn, dn of Jacobi for a modulus given by its complement `kc` > 0.
/// Source: arithmetic-geometric mean, Abramowitz and Stegun, 16.4.
struct JacobiElliptic {
  double sn, cn, dn;
};

/// Quarter period K.
double complete_integral(double kc);

JacobiElliptic jacobi(double u, double kc);

/// The torque-free asymmetric top I = (1, 2, 3) kg m^2 from (a, 1, 0) rad/s,
/// which turns over again and again about its intermediate axis.
/// Source: Landau and Lifshitz, Mechanics, sec. 37, axes 1 and 3 exchanged
/// because 2 E I_2 > L^2.
class FreeTop {
 public:
  explicit FreeTop(double a);

  [[nodiscard]] Vector3 inertia() const { return I_; }
  /// Between two zeros of Omega_2 [s].
  [[nodiscard]] double flip_time() const { return 2.0 * quarter_ / rate_; }
  [[nodiscard]] Vector3 angular_velocity(double t) const;

 private:
  Vector3 I_{1.0, 2.0, 3.0};
  Vector3 amplitude_;
  double rate_ = 0.0;     // [1/s]
  double kc_ = 0.0;       // complementary modulus
  double quarter_ = 0.0;  // K
};

}  // namespace limber::testing
