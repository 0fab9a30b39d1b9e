// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/equations/energy_balance.hpp"
#include "limber/dynamics/equations/workspace.hpp"
#include "limber/dynamics/system/system_state.hpp"

namespace limber::dynamics {

/// All fields except `dissipated` and `work`, which depend on the history.
[[nodiscard]] EnergyBalance calc_energy(const SystemModel& model,
                                        const SystemState& state);
/// The same with `terms` of make_terms(model), without allocation.
[[nodiscard]] EnergyBalance calc_energy(const SystemModel& model,
                                        const SystemState& state,
                                        SystemTerms& terms);

}  // namespace limber::dynamics
