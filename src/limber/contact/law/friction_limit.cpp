// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/law/friction_limit.hpp"

#include <cmath>

#include "limber/contact/law/check_value.hpp"

namespace limber::contact {

void check(const FrictionLimit& limit) {
  check_value(limit.sliding >= 0.0, "friction", limit.sliding, ">= 0");
  check_value(limit.excess >= 0.0, "static friction less that of sliding",
              limit.excess, ">= 0");
  check_value(limit.speed > 0.0, "Stribeck speed [m/s]", limit.speed, "> 0");
}

FrictionCoefficient find_coefficient(const FrictionLimit& limit, double speed) {
  if (limit.excess == 0.0) return {.value = limit.sliding};
  const double ratio = speed / limit.speed;
  const double bump = limit.excess * std::exp(-ratio * ratio);
  return {.value = limit.sliding + bump,
          .slope = -2.0 * ratio / limit.speed * bump};
}

}  // namespace limber::contact
