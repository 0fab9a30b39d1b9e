// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/law/rolling_resistance.hpp"

#include <cmath>

#include "limber/contact/law/load_shells.hpp"
#include "limber/contact/law/within.hpp"

namespace limber::contact {

using Vector2 = Eigen::Vector2d;

// Of the critical damping of bodies that rotate about their centres.
constexpr double kDamping = 0.3;

RollingResponse resist_rolling(double arm, const RollingSpring& before,
                               const RollingLoad& load,
                               const RollingMotion& motion) {
  RollingResponse out;
  const double most = arm * load.force;
  const double k = 3.0 * load.stiffness * arm * arm;
  if (!(most > 0.0)) {
    out.slip_work = find_energy(before);
    return out;
  }
  Vector2 released = before.moment;
  if (k < before.stiffness) released *= k / before.stiffness;
  const Vector2 trial = released + k * motion.rotation;
  const Within<2> spring(trial, most);
  out.next = {k, spring.value};
  out.energy = find_energy(out.next);
  out.slip_work = find_energy(before) - find_energy({k, released}) +
                  spring.value.dot(trial - spring.value) / k;
  const double c =
      load.inverse_inertia > 0.0
          ? find_spring_damping(k, 1.0 / load.inverse_inertia, kDamping)
          : 0.0;
  const Within<2> sum(-spring.value - c * motion.rate, most);
  out.moment = sum.value;
  out.damper_power = (-spring.value - sum.value).dot(motion.rate);
  out.by_rotation = -k * sum.by_value * spring.by_value;
  out.by_rate = -c * sum.by_value;
  out.by_force = arm * (sum.by_most - sum.by_value * spring.by_most);
  return out;
}

double find_energy(const RollingSpring& spring) {
  return spring.stiffness > 0.0
             ? 0.5 * spring.moment.squaredNorm() / spring.stiffness
             : 0.0;
}

}  // namespace limber::contact
