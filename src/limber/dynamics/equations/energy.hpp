// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/system/system_state.hpp"
#include "limber/dynamics/terms/energy_balance.hpp"
#include "limber/dynamics/terms/system_terms.hpp"

namespace limber::dynamics {

/// Elastic energy of a body: of its modes and the Maxwell elements on these, or
/// of an unreduced one [J]. @param terms at `state`
[[nodiscard]] double find_elastic_energy(const SystemModel& model,
                                         std::size_t body,
                                         const SystemState& state,
                                         const SystemTerms& terms);

/// All fields except `dissipated` and `work`, which depend on the history.
[[nodiscard]] EnergyBalance calc_energy(const SystemModel& model,
                                        const SystemState& state);
/// The same with `terms` of make_terms(model), without allocation.
[[nodiscard]] EnergyBalance calc_energy(const SystemModel& model,
                                        const SystemState& state,
                                        SystemTerms& terms);

}  // namespace limber::dynamics
