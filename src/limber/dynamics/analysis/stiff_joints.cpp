// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/analysis/stiff_joints.hpp"

#include <algorithm>

namespace limber::dynamics {

std::optional<SystemModel> replace_ideal_joints(const SystemModel& model) {
  const bool has_any =
      std::any_of(model.couplers.begin(), model.couplers.end(),
                  [](const Coupler& c) { return joints::is_ideal(c.law); });
  if (!has_any) return std::nullopt;
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
