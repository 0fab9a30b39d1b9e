// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/terms/mean_frame.hpp"

namespace limber::dynamics {

/// A Newmark step with the accelerations a and a_next at its ends:
/// u + h u' + h^2 (lag a + beta a_next).
struct NewmarkStep {
  double h = 0.0;     ///< [s]
  double lag = 0.0;   ///< [-]
  double beta = 0.0;  ///< [-]
};

/// Initial guess of Newton's method for a rotating unreduced body: nodal
/// accelerations for which it moves over the step as a rigid body. Nodes that
/// continue in straight lines stretch a body that rotates by theta by
/// theta^2 / 2; the stiff axial motion of a slender body, which no step
/// resolves, then spoils convergence.
///
/// Equation   x + u <- p + h p' + s h^2 p'' + exp(h w + s h^2 w') (x + u - p);
///            p'' + w' x (c - p) + w x (w x (c - p)) = mean of u'',
///            w' = spread sum_i R y_i x (u''_i - w x (w x (x_i + u_i - p)))
///            s = lag + beta
/// @param accelerations of all unknowns
/// @param a, a_next the step's, of all unknowns; a_next is written for nodes of
/// bodies that rotate by more than 0.01 rad
/// @returns whether any does
bool predict_rotations(const SystemModel& model, const SystemState& from,
                       const VectorX& accelerations, const VectorX& a,
                       const NewmarkStep& step, VectorX& a_next);

/// Applies the rotational part of Newton's correction of each unreduced body as
/// a finite rotation, without strain: a linear one by theta stretches the body
/// by theta^2 / 2, too much for stiff directions.
///
/// Equation   d + (exp(theta) - 1 - theta x) (x + u - p),
///            theta = spread sum_i R y_i x d_i
/// @param state at which the correction was computed
/// @param correction of all unknowns; only nodes are changed
void rotate_corrections(const SystemModel& model, const SystemState& state,
                        VectorX& correction);

}  // namespace limber::dynamics
