// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "limber/common/records/fields.hpp"
#include "limber/contact/law/friction_limit.hpp"

namespace limber::contact {

/// Parameters of a contact that a user can set.
struct ContactParameters {
  FrictionLimit friction = {};  ///< none
  /// Arm b >= 0 of the normal force that resists rolling at most [m].
  double rolling_friction = 0.0;
  double restitution = 1.0;           ///< of a free impact, in [0, 1] [-]
  std::optional<double> radius = {};  ///< R_e > 0 in place of the shapes' [m]
  std::optional<double> stiffness = {};  ///< Hertz's k > 0 in place of that of
                                         ///< the materials and R_e [N/m^1.5]
  std::optional<double> damping = {};    ///< b >= 0 in place of that of the
                                         ///< restitution [s/m]
};

constexpr auto fields_of(const ContactParameters*) {
  return list_fields("contact", "friction", "rolling friction [m]",
                     "restitution", "radius [m]", "stiffness [N/m^1.5]",
                     "damping [s/m]");
}

/// @throws InputError for a value outside its range.
void check(const ContactParameters& parameters);

}  // namespace limber::contact
