// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "limber/dynamics/newton/constraint_wrenches.hpp"

namespace limber::dynamics {

/// The model with stiff joints in place of ideal ones, for analyses whose
/// unknowns are positions alone; none if it has no ideal joint. Where their
/// stiffness is a default, they add 1 / kIdealStiffnessRatio to the flexibility
/// of the stiffer side. Their stiffness acts beside the wrench that a state has
/// for the ideal ones (CouplerMemory::constraint_wrench).
[[nodiscard]] std::optional<SystemModel> replace_ideal_joints(
    const SystemModel& model);

/// Sets that wrench to what the stiff joints transmit at a state, so that they
/// transmit as much without a deflection.
/// @param stiff of `model`, by replace_ideal_joints
void store_wrenches(const SystemModel& model, const SystemModel& stiff,
                    SystemState& state);

/// A solution with stiff joints in place of ideal ones, solved again so that
/// these do not deflect, with what holds the ideal ones.
/// @param first the solution of `stiff`
/// @param solve it again from a state
template <typename Solve>
[[nodiscard]] SystemState solve_without_deflection(const SystemModel& model,
                                                   const SystemModel& stiff,
                                                   SystemState first,
                                                   const Solve& solve) {
  store_wrenches(model, stiff, first);
  SystemState found = solve(first);
  set_constraint_wrenches(model, found);
  return found;
}

}  // namespace limber::dynamics
