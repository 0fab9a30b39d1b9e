// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

/// Stiffnesses of a contact from the materials of its two sides.
namespace limber::contact {

/// Material of one side, isotropic and linear.
struct SurfaceMaterial {
  double youngs_modulus = 0.0;  ///< E > 0 [Pa]
  double poisson_ratio = 0.0;   ///< -1 < nu <= 0.5 [-]
};

/// Moduli of two half spaces in contact, as their stiffnesses use them.
///
/// Equation   with the sums over the sides that have a material:
///            1/E* = sum (1 - nu^2) / E,   k_n = 2 a E*,
///            1/G* = sum (2 - nu) / G,     k_t = 8 a G*,
///            1/G_r = sum 1 / G,           k_r = 16 a^3 G_r / 3,
///            a the radius of the touching area, G = E / (2 (1 + nu)).
///            Of equal sides k_t / k_n = 2 (1 - nu) / (2 - nu).
/// Source     [@johnson1985, chs. 4 and 7]; k_t [@mindlin1949]
/// Limits     k_t and k_r hold for an area that does not slip
struct PairModuli {
  double normal = 0.0;      ///< E* [Pa]
  double tangential = 0.0;  ///< G* [Pa]
  double torsional = 0.0;   ///< G_r [Pa]

  /// k_t / k_n = 4 G* / E* [-]
  [[nodiscard]] double tangential_ratio() const {
    return 4.0 * tangential / normal;
  }
};

/// A side without a material is rigid: it adds no compliance.
/// @return none if neither side has a material.
/// @throws InputError for a modulus or ratio outside its range.
[[nodiscard]] std::optional<PairModuli> find_pair_moduli(
    const std::optional<SurfaceMaterial>& side_A,
    const std::optional<SurfaceMaterial>& side_B);

/// k_t / k_n of a pair without materials: that of nu = 0.3 [-].
inline constexpr double kDefaultTangentialRatio = 2.0 * 0.7 / 1.7;

/// Hertz's k = 4/3 E* sqrt(R_e) [N/m^1.5].
/// @param modulus E* > 0 [Pa]
/// @param radius R_e > 0, 1/R_e = 1/R_A + 1/R_B [m]
/// @throws InputError for values outside their range.
[[nodiscard]] double find_hertz_stiffness(double modulus, double radius);

/// Radius a = sqrt(R_e d_H) of the contact area [m].
/// @param hertz_depth indentation d_H of the two surfaces >= 0 [m]
/// @throws ContractError for values outside their range.
[[nodiscard]] double find_contact_radius(double radius, double hertz_depth);

}  // namespace limber::contact
