// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace limber::contact {

/// Complete elliptic integrals of the first and second kind by the
/// arithmetic-geometric mean.
///
/// Equation   K = pi / (2 mean), E = K (1 - defect)
struct EllipticIntegral {
  double mean = 1.0;    ///< arithmetic-geometric, of 1 and k' [-]
  double defect = 0.0;  ///< 1 - E / K [-]
};

/// @param side k' in (0, 1), the complementary modulus
[[nodiscard]] EllipticIntegral find_elliptic_integral(double side);

}  // namespace limber::contact
