// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/law/contact_damping.hpp"

#include <cmath>

namespace limber::contact {

DampingRate find_damping(double factor, const TouchMotion& motion) {
  const double F = motion.force;
  const double mean_square = motion.square / F;
  const double speed =
      std::sqrt(mean_square + 2.0 * motion.energy * motion.inverse_mass);
  if (factor == 0.0 || F == 0.0 || speed == 0.0) return {};
  const double s = factor / speed;
  const double by_mean_square = -0.5 * s / (speed * speed);
  return {.s = s,
          .by_force = -by_mean_square * mean_square / F,
          .by_square = by_mean_square / F,
          .by_energy = 2.0 * by_mean_square * motion.inverse_mass};
}

DampedForce damp(const ElasticForce& elastic, double rate,
                 const DampingRate& damping) {
  const double f = elastic.force;
  const double grip = 1.0 + damping.s * rate;
  if (grip <= 0.0) return {.dissipation = -f * rate, .is_cut = f > 0.0};
  const double by_depth =
      elastic.stiffness * (damping.by_force + damping.by_square * rate * rate) +
      elastic.energy_slope * damping.by_energy;
  const double by_rate = 2.0 * f * rate * damping.by_square;
  return {.force = f * grip,
          .dissipation = f * damping.s * rate * rate,
          .stiffness = elastic.stiffness * grip + f * rate * by_depth,
          .damping = f * (damping.s + rate * by_rate)};
}

}  // namespace limber::contact
