// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/equations/workspace.hpp"

namespace limber::dynamics {

/// A value for each velocity component, in the frames of the state: one per
/// body, then modal coordinates and nodes of unreduced bodies.
struct Rates {
  std::vector<Vector3> translation;  ///< world frame [m, m/s or m/s^2]
  std::vector<Vector3> rotation;     ///< body frame [rad, rad/s or rad/s^2]
  VectorX modes;                     ///< [kg^1/2 m, .../s or .../s^2]
  VectorX nodes;                     ///< home frame [m, m/s or m/s^2]
};
[[nodiscard]] Rates make_rates(const SystemModel& model);

/// Residual of the equations of motion at evaluated `terms`.
///
/// Equation   r = M a + bias - forces; zero for fixed coordinates
/// @param residual rows as increments of NewtonMatrix [N, N m, N/kg^1/2]
void calc_residual(const SystemModel& model, const Rates& acceleration,
                   SystemTerms& terms, VectorX& residual);

}  // namespace limber::dynamics
