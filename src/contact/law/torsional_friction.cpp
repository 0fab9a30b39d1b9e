// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/law/torsional_friction.hpp"

#include <numbers>

#include "limber/contact/law/check_value.hpp"
#include "limber/contact/law/cone_return.hpp"

namespace limber::contact {

TorsionalFriction::TorsionalFriction(const Parameters& parameters)
    : parameters_(parameters) {
  const Parameters& p = parameters;
  check_value(p.friction >= 0.0, "friction", p.friction, ">= 0");
  check_value(p.stiffness > 0.0, "torsional stiffness [N m/rad]", p.stiffness,
              "> 0");
  check_value(p.damping >= 0.0, "torsional damping [N m s/rad]", p.damping,
              ">= 0");
}

TwistResponse TorsionalFriction::evaluate(const TwistMemory& memory,
                                          const TwistMotion& motion) const {
  const Parameters& p = parameters_;
  const double arm =  // of the limit, over f
      3.0 * std::numbers::pi / 16.0 * p.friction * motion.contact_radius;
  using Cone = ConeReturn<1>;
  const Cone::Vector trial(memory.twist + motion.increment);
  const Cone::Vector velocity(motion.velocity);
  const Cone cone = Cone::find({.trial = trial,
                                .velocity = velocity,
                                .plane = Cone::Matrix::Identity(),
                                .stiffness = p.stiffness,
                                .damping = p.damping,
                                .limit = arm * motion.normal_force});
  return {.moment = cone.force[0],
          .slips = cone.slips,
          .energy = cone.energy,
          .slip_work = cone.slip_work,
          .damper_power = cone.damper_power,
          .by_increment = cone.by_trial(0, 0),
          .by_velocity = cone.by_velocity(0, 0),
          .by_normal_force = 4.0 / 3.0 * arm * cone.by_limit[0],
          .next = {cone.bristle[0]}};
}

}  // namespace limber::contact
