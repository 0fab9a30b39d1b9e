// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "dynamics/workspace.hpp"

namespace limber::dynamics {

/// A value for each velocity component, in axes of the state's: one a body,
/// then modal coordinates and nodes of unreduced bodies.
struct Rates {
  std::vector<Vector3> translation;  ///< world axes
  std::vector<Vector3> rotation;     ///< body axes
  VectorX modes;
  VectorX nodes;  ///< home axes
};
[[nodiscard]] Rates make_rates(const SystemModel& model);

/// What the equations of motion leave at evaluated `terms`.
///
/// Equation   r = M a + bias - forces; zero where nothing moves
/// @param residual rows as increments of NewtonMatrix [N, N m, N/kg^1/2]
void calc_residual(const SystemModel& model, const Rates& acceleration,
                   SystemTerms& terms, VectorX& residual);

}  // namespace limber::dynamics
