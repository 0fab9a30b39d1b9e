// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/system/system_state.hpp"

namespace limber::dynamics {

/// Sets what holds ideal joints at a state (CouplerMemory::constraint_wrench)
/// by its accelerations; without such joints it does nothing.
///
/// Equation   M a + bias = f + sum_c G_c' w_c,  G_c a + gamma_c = 0, gamma of
///            find_velocity_terms
/// @throws NumericalError naming the coupler or body of a singular system.
void set_constraint_wrenches(const SystemModel& model, SystemState& state);

}  // namespace limber::dynamics
