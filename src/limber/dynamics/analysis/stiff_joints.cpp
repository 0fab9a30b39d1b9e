// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/analysis/stiff_joints.hpp"

#include <algorithm>

namespace limber::dynamics {

const Coupler* find_ideal_joint(const SystemModel& model) {
  const auto found =
      std::find_if(model.couplers.begin(), model.couplers.end(),
                   [](const Coupler& c) { return joints::is_ideal(c.law); });
  return found == model.couplers.end() ? nullptr : &*found;
}

std::optional<SystemModel> replace_ideal_joints(const SystemModel& model) {
  if (find_ideal_joint(model) == nullptr) return std::nullopt;
  SystemModel stiff = model;
  for (Coupler& coupler : stiff.couplers) {
    if (!joints::is_ideal(coupler.law)) continue;
    const joints::Joint::Parameters joint =
        std::get<joints::Joint>(coupler.law).parameters();
    coupler.law =
        joints::Joint(joint.constraint, joint.coordinates, joint.elements);
  }
  return stiff;
}

}  // namespace limber::dynamics
