// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/law/contact_parameters.hpp"

#include "limber/contact/law/check_value.hpp"

namespace limber::contact {

void check(const ContactParameters& parameters) {
  check(parameters.friction);
  check_value(parameters.rolling_friction >= 0.0, "rolling friction",
              parameters.rolling_friction, ">= 0 m");
  const double e = parameters.restitution;
  check_value(e >= 0.0 && e <= 1.0, "restitution", e, "0 to 1");
  const auto check_positive = [](const std::optional<double>& value,
                                 const char* what, const char* expected) {
    if (value) check_value(*value > 0.0, what, *value, expected);
  };
  check_positive(parameters.radius, "radius", "> 0 m");
  check_positive(parameters.stiffness, "stiffness", "> 0 N/m^1.5");
  const double b = parameters.damping.value_or(0.0);
  check_value(b >= 0.0, "damping", b, ">= 0 s/m");
}

}  // namespace limber::contact
