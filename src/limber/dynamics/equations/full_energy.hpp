// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/terms/energy_balance.hpp"
#include "limber/dynamics/terms/system_terms.hpp"
#include "limber/dynamics/system/system_state.hpp"

namespace limber::dynamics {

/// Adds kinetic energies and momenta of unreduced bodies.
///
/// Equation   kinetic_rigid = m v^2/2 + w' J w/2 of the mean-axis frame, J of
///            the deformed nodes; kinetic_modal = u'' M u' / 2 less that
void add_full_energy(const SystemModel& model, const SystemState& state,
                     SystemTerms& terms, EnergyBalance& balance);

}  // namespace limber::dynamics
