// SPDX-License-Identifier: BSD-3-Clause
// ContactPair's forces of all features that touch, damped together.
#include <algorithm>
#include <cmath>

#include "limber/contact/contact_pair.hpp"
#include "limber/contact/point_numbers.hpp"
#include "limber/contact/touch.hpp"

namespace limber::contact {

ElasticPoint ContactPair::find_elastic(const PointMotion& motion, std::size_t i,
                                       const PadLaw::Response& pads) const {
  if (!is_pad(i)) return law_.find_elastic(motion);
  const auto pad = static_cast<Eigen::Index>(i);
  const double force = pads.force[pad];
  return {
      .force = {force, pads.stiffness(pad, pad), force},
      .area = pads_->area(i),
      .flat_stiffness = pads_->law().uniform_stiffness(static_cast<int>(i))};
}

void ContactPair::gather(const joints::PairBodies& bodies, double t,
                         std::span<const double> memory,
                         std::span<const Meeting> meetings, Touch& touch,
                         joints::PairResponse& out) const {
  evaluate_pads(meetings, touch.pads);
  touch.motion.energy = touch.pads.energy;
  for (std::size_t i = 0; i < count_features(); ++i) {
    const Meeting& meeting = meetings[i];
    if (!touches(meeting, i, touch.pads)) continue;
    TouchingPoint& at = touch.points.add();
    at.feature = i;
    at.point = out.points().size();
    at.before = load_memory(numbers_of(i, memory));
    at.motion = place(bodies, meeting, at.before, t, out.add());
    at.elastic = find_elastic(at.motion, i, touch.pads);
    touch.sum(bodies, meeting.p_W, at);
  }
}

double ContactPair::find_inverse_mass(const joints::PairBodies& bodies,
                                      const Touch& touch) const {
  return mass_.find_inverse(bodies, touch.load, touch.motion.force,
                            touch.memory);
}

DampingRate ContactPair::find_damping(const joints::PairBodies& bodies,
                                      const Touch& touch) const {
  TouchMotion motion = touch.motion;
  if (motion.force == 0.0) return {};
  motion.inverse_mass = find_inverse_mass(bodies, touch);
  return law_.find_damping(motion);
}

// k = F^2 / (2 W), that of a spring with the same force and energy.
void ContactPair::set_rates(const joints::PairBodies& bodies,
                            const Touch& touch,
                            joints::TouchReading& reading) const {
  constexpr double kMostDamping = 4.0;
  const TouchMotion& motion = touch.motion;
  if (!(motion.force > 0.0)) return;
  const double inverse_mass = find_inverse_mass(bodies, touch);
  reading.normal_speed = std::sqrt(motion.square / motion.force);
  if (!(motion.energy > 0.0)) return;
  reading.elastic_speed = std::sqrt(2.0 * motion.energy * inverse_mass);
  reading.frequency = motion.force * inverse_mass / reading.elastic_speed *
                      std::clamp(law_.damping_factor(), 1.0, kMostDamping);
}

void ContactPair::respond(const joints::PairBodies& bodies,
                          std::span<const Meeting> meetings, const Touch& touch,
                          joints::PairResponse& out) const {
  const DampingRate damping = find_damping(bodies, touch);
  CoupledPads pads;
  for (const TouchingPoint& at : touch.points.all()) {
    const Meeting& meeting = meetings[at.feature];
    const PointResponse response =
        law_.evaluate(at.motion, at.elastic, damping, at.before);
    set_response(response, out.points()[at.point], out);
    out.energy += at.elastic.energy + response.energy;
    if (is_pad(at.feature)) {
      pads.add(at.point, at.feature, response.by_elastic_W, meeting.normal_W);
    }
    if (has_twist_) add_twist(bodies, meeting, response, at.point, out);
  }
  pads.couple(touch.pads, out);
}

}  // namespace limber::contact
