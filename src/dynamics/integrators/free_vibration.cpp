// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/integrators/free_vibration.hpp"

namespace limber::dynamics {

FreeVibration::FreeVibration(const SystemModel& model) {
  for (const BodyModel& body : model.bodies) {
    const VectorX& lambda = flexbody::rest_stiffness(body.elasticity);
    for (int k = 0; k < body.modes; ++k) {
      oscillators_.emplace_back(lambda[k], body.damping[k]);
    }
  }
  responses_.resize(oscillators_.size());
}

void FreeVibration::set_time(double time) {
  if (time == time_) return;
  for (std::size_t i = 0; i < oscillators_.size(); ++i) {
    responses_[i] = oscillators_[i].find_free_response(time);
  }
  time_ = time;
}

}  // namespace limber::dynamics
