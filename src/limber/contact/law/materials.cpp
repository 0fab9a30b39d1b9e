// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/law/materials.hpp"

#include <cmath>

#include "limber/common/errors.hpp"
#include "limber/contact/law/check_value.hpp"

namespace limber::contact {
namespace {

// Compliances per unit of the area's radius, of one side.
struct Compliances {
  double normal = 0.0;      // [1/Pa]
  double tangential = 0.0;  // [1/Pa]
  double torsional = 0.0;   // [1/Pa]
};

Compliances find_compliances(const std::optional<SurfaceMaterial>& side) {
  if (!side) return {};
  const double E = side->youngs_modulus;
  const double nu = side->poisson_ratio;
  check_value(E > 0.0, "Young's modulus [Pa]", E, "> 0");
  check_value(nu > -1.0 && nu <= 0.5, "Poisson's ratio", nu,
              "more than -1, at most 0.5");
  const double G = E / (2.0 * (1.0 + nu));
  return {.normal = (1.0 - nu * nu) / E,
          .tangential = (2.0 - nu) / G,
          .torsional = 1.0 / G};
}

}  // namespace

std::optional<PairModuli> find_pair_moduli(
    const std::optional<SurfaceMaterial>& side_A,
    const std::optional<SurfaceMaterial>& side_B) {
  if (!side_A && !side_B) return std::nullopt;
  const Compliances a = find_compliances(side_A);
  const Compliances b = find_compliances(side_B);
  return PairModuli{.normal = 1.0 / (a.normal + b.normal),
                    .tangential = 1.0 / (a.tangential + b.tangential),
                    .torsional = 1.0 / (a.torsional + b.torsional)};
}

double find_hertz_stiffness(double modulus, double radius) {
  check_value(modulus > 0.0, "contact modulus [Pa]", modulus, "> 0");
  check_value(radius > 0.0, "radius [m]", radius, "> 0");
  return 4.0 / 3.0 * modulus * std::sqrt(radius);
}

double find_contact_radius(double radius, double hertz_depth) {
  LIMBER_EXPECT(radius > 0.0);
  LIMBER_EXPECT(hertz_depth >= 0.0);
  return std::sqrt(radius * hertz_depth);
}

}  // namespace limber::contact
