// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/integrators/maxwell_motion.hpp"

#include "limber/dynamics/terms/maxwell.hpp"

namespace limber::dynamics {

MaxwellMotion::MaxwellMotion(const SystemModel& model, Rule rule)
    : model_(model), rule_(rule) {
  for (const BodyModel& body : model.bodies) {
    steps_.emplace_back(body.maxwell.size());
  }
}

void MaxwellMotion::set_step(double h, SystemTerms& terms) {
  for (std::size_t b = 0; b < steps_.size(); ++b) {
    if (h != h_) rule_(model_.bodies[b].maxwell, h, steps_[b]);
    terms.bodies[b].maxwell_stiffness = steps_[b].stiffness;
  }
  h_ = h;
}

void MaxwellMotion::advance(const SystemState& from, SystemState& to) const {
  for (std::size_t b = 0; b < steps_.size(); ++b) {
    const BodyModel& body = model_.bodies[b];
    const auto eta0 = from.eta.segment(body.offset, body.modes);
    const auto eta1 = to.eta.segment(body.offset, body.modes);
    for (Eigen::Index j = 0; j < body.maxwell.size(); ++j) {
      maxwell_of(body, to.maxwell).col(j) =
          steps_[b].keep[j] * maxwell_of(body, from.maxwell).col(j) +
          steps_[b].gain[j] * (eta1 - eta0);
    }
  }
}

}  // namespace limber::dynamics
