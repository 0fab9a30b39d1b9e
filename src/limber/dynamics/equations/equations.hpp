// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/terms/system_terms.hpp"

/// The equations of motion of docs/theory/equations.md, at each fidelity.
namespace limber::dynamics {

/// Terms of a model's size, with forces of zero.
[[nodiscard]] SystemTerms make_terms(const SystemModel& model);

/// Fills R_WB, J, H and the bias terms of every body.
void calc_inertia_terms(const SystemModel& model, const SystemState& state,
                        SystemTerms& terms);

/// Fills forces of couplers, pairs, loads and gravity, and their powers; needs
/// R_WB from calc_inertia_terms. `side` selects the limit of a load that jumps
/// at state.t. With WrenchSource::iterate, couplers exert the given `applied`
/// wrench; their laws are evaluated too.
void calc_forces(const SystemModel& model, const SystemState& state, Side side,
                 SystemTerms& terms, WrenchSource source = WrenchSource::law);

/// Both of the above.
void calc_terms(const SystemModel& model, const SystemState& state, Side side,
                SystemTerms& terms, WrenchSource source = WrenchSource::law);

/// Sets all forces and bias terms to zero.
void clear_forces(const SystemModel& model, SystemTerms& terms);

/// Solves each body's 6 + m equations for its accelerations.
/// @param accelerations of all unknowns (unknowns.hpp)
void solve_accelerations(const SystemModel& model, const SystemTerms& terms,
                         VectorX& accelerations);

/// Residual of the equations of motion at evaluated `terms`.
///
/// Equation   r = M a + bias - forces; zero for fixed coordinates
/// @param acceleration of all unknowns (unknowns.hpp)
/// @param residual likewise [N, N m, N/kg^1/2]
void calc_residual(const SystemModel& model, const VectorX& acceleration,
                   SystemTerms& terms, VectorX& residual);

}  // namespace limber::dynamics
