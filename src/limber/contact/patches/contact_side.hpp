// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "limber/common/records/manifest.hpp"
#include "limber/contact/law/contact_parameters.hpp"
#include "limber/contact/law/effective_mass.hpp"
#include "limber/contact/law/materials.hpp"
#include "limber/contact/potential/body_kind.hpp"
#include "limber/contact/shapes/shape.hpp"

namespace limber::contact {

/// One of the two bodies of a contact.
struct ContactSide {
  Shape shape;
  std::optional<SurfaceMaterial> material;  ///< none: rigid
  double mass = 0.0;  ///< of the body; infinity of the world [kg]
  /// Of the body, about Bo, its centre of mass; zero of the world, and of
  /// bodies that no contact rotates, such as a sphere at Bo [kg m^2].
  Matrix3 inertia_B = Matrix3::Zero();
  /// Convex parts of a rigid mesh or of a flexible surface with slices, in its
  /// frame; none of others.
  std::vector<PlacedBody> bodies = {};
  /// Of a flexible surface the slice of each of these.
  std::vector<std::size_t> slices = {};
};

/// Both sides and the law between them: everything that forces depend on.
void describe(Manifest& out, const ContactSide& A, const ContactSide& B,
              const ContactParameters& parameters);

/// The reduced mass of both bodies [kg].
/// @throws InputError if neither has a finite mass.
[[nodiscard]] double check_masses(const ContactSide& A, const ContactSide& B);

/// The effective mass of both bodies against normal forces: as free bodies,
/// unless a mobility of joints is kept in their pair's memory, whose last
/// kNumbers are those of a joints::PairMobility by columns, zero without
/// joints.
class OpposedMass {
 public:
  static constexpr std::size_t kNumbers = 144;

  /// @throws InputError for a restitution or rolling friction of a body that
  /// may rotate without inertia.
  OpposedMass(const ContactSide& A, const ContactSide& B,
              const ContactParameters& parameters);

  /// As find_inverse_mass [1/kg].
  [[nodiscard]] double find_inverse(const joints::PairBodies& bodies,
                                    const NormalLoad& load, double F,
                                    std::span<const double> memory) const;
  static void keep(const joints::PairMobility& mobility,
                   std::span<double> memory);

 private:
  FreeBody A_;
  FreeBody B_;
};

}  // namespace limber::contact
