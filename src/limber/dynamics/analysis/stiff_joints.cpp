// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/analysis/stiff_joints.hpp"

#include "limber/common/index.hpp"

namespace limber::dynamics {

std::optional<SystemModel> replace_ideal_joints(const SystemModel& model) {
  if (!has_ideal_joints(model)) return std::nullopt;
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

void store_wrenches(const SystemModel& model, const SystemModel& stiff,
                    SystemState& state) {
  for (CouplerIndex c(0); c < std::ssize(model.couplers); ++c) {
    if (!joints::is_ideal(model.couplers[index(c)].law)) continue;
    const joints::CouplerLaw& law = stiff.couplers[index(c)].law;
    const joints::RelativeMotion motion = find_relative_motion(stiff, state, c);
    joints::CouplerMemory& memory = state.memory[index(c)];
    memory.constraint_wrench =
        joints::find_constraint_gap(law, motion).directions *
        joints::evaluate(law, motion, memory, now_of(state)).wrench;
  }
}

}  // namespace limber::dynamics
