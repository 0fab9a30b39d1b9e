// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/records/fields.hpp"

namespace limber::contact {

/// Coefficient of friction, which may fall from rest to sliding.
///
/// Equation   mu(v) = mu_k + (mu_s - mu_k) exp(-(v / v_s)^2)
/// Source     Stribeck's curve in the form of [@armstrong1994]
struct FrictionLimit {
  double sliding = 0.0;  ///< mu_k >= 0 [-]
  double excess = 0.0;   ///< mu_s - mu_k >= 0, at rest [-]
  double speed = 0.01;   ///< v_s > 0 [m/s]
};

constexpr auto fields_of(const FrictionLimit*) {
  return list_fields("friction", "sliding", "excess", "speed [m/s]");
}

/// @throws InputError for a value outside its range.
void check(const FrictionLimit& limit);

struct FrictionCoefficient {
  double value = 0.0;  ///< mu [-]
  double slope = 0.0;  ///< d mu / d v [s/m]
};
[[nodiscard]] FrictionCoefficient find_coefficient(const FrictionLimit& limit,
                                                   double speed);

}  // namespace limber::contact
