// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/patches/contact_side.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "limber/common/errors.hpp"
#include "limber/contact/shapes/shape_measures.hpp"

namespace limber::contact {
namespace {

// Of which normal forces rotate the body.
bool is_turned(const Shape& shape) {
  const bool is_ball = std::holds_alternative<Sphere>(shape.kind);
  return !is_ball || !shape.X_BS.p.isZero(0.0);
}

void describe_side(Manifest& out, const char* name, const ContactSide& side) {
  out.within(name, [&] {
    describe(out, "shape", side.shape);
    out.add("mass [kg]", side.mass);
    const Matrix3& J = side.inertia_B;
    out.add("inertia [kg m^2]", {J.data(), J.data() + J.size()}, "3 x 3");
    if (!side.material) return;
    out.add("youngs modulus [Pa]", side.material->youngs_modulus);
    out.add("poisson ratio", side.material->poisson_ratio);
  });
}

FreeBody make_free_body(const ContactSide& side,
                        const ContactParameters& parameters) {
  if (parameters.rolling_friction > 0.0 && std::isfinite(side.mass) &&
      side.inertia_B.isZero(0.0)) {
    throw InputError(
        "contact: rolling_friction needs the inertia of both bodies");
  }
  const bool is_damped = parameters.restitution < 1.0 && !parameters.damping;
  if (is_damped && std::isfinite(side.mass) && is_turned(side.shape) &&
      side.inertia_B.isZero(0.0)) {
    throw InputError("contact: restitution needs the inertia of both bodies");
  }
  return {side.mass, side.inertia_B};
}

}  // namespace

void describe(Manifest& out, const ContactSide& A, const ContactSide& B,
              const ContactParameters& parameters) {
  describe(out, "parameters", parameters);
  describe_side(out, "body A", A);
  describe_side(out, "body B", B);
}

double check_masses(const ContactSide& A, const ContactSide& B) {
  LIMBER_EXPECT(A.mass > 0.0 && B.mass > 0.0);
  const double mass = 1.0 / (1.0 / A.mass + 1.0 / B.mass);
  if (std::isfinite(mass)) return mass;
  throw InputError("contact: neither side can move");
}

OpposedMass::OpposedMass(const ContactSide& A, const ContactSide& B,
                         const ContactParameters& parameters)
    : A_(make_free_body(A, parameters)), B_(make_free_body(B, parameters)) {}

double OpposedMass::find_inverse(const joints::PairBodies& bodies,
                                 const NormalLoad& load, double F,
                                 std::span<const double> memory) const {
  const Eigen::Map<const joints::PairMobility> Y(
      memory.last<kNumbers>().data());
  return Y.isZero(0.0) ? find_inverse_mass(A_, B_, bodies, load, F)
                       : find_inverse_mass(Y, bodies, load, F);
}

void OpposedMass::keep(const joints::PairMobility& mobility,
                       std::span<double> memory) {
  std::copy_n(mobility.data(), kNumbers, memory.last<kNumbers>().begin());
}

}  // namespace limber::contact
