// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/law/contact_damping.hpp"

#include <algorithm>
#include <cmath>

#include "limber/common/errors.hpp"
#include "limber/common/restitution.hpp"
#include "limber/contact/law/check_value.hpp"

namespace limber::contact {

ContactDamping find_contact_damping(double restitution, double speed) {
  check_value(restitution >= 0.0 && restitution <= 1.0, "restitution",
              restitution, "0 to 1");
  LIMBER_EXPECT(speed >= 0.0 && std::isfinite(speed));
  ContactDamping damping;
  damping.restitution = std::max(restitution, kLeastRestitution);
  damping.speed = std::max(speed, kLeastTouchSpeed);
  damping.coefficient =
      find_restitution_damping(damping.restitution, damping.speed);
  return damping;
}

DampedForce damp(const ElasticForce& elastic, double rate, double coefficient) {
  const double b = coefficient;
  const double f = elastic.force;
  const double grip = 1.0 + b * rate;
  if (grip <= 0.0) return {.dissipation = -f * rate, .is_cut = f > 0.0};
  return {.force = f * grip,
          .dissipation = f * b * rate * rate,
          .stiffness = elastic.stiffness * grip,
          .damping = f * b};
}

}  // namespace limber::contact
