// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/equations/mean_frame.hpp"

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
/// @param uddot_H nodal accelerations, ordered as SystemState::u_H [m/s^2]
/// @param a_H the step's a, likewise [m/s^2]
/// @param a_next_H its a_next [m/s^2]; written for bodies that rotate by more
/// than 0.01 rad
/// @returns whether any does
bool predict_turns(const SystemModel& model, const SystemState& from,
                   const VectorX& uddot_H, const VectorX& a_H,
                   const NewmarkStep& step, VectorX& a_next_H);

/// Applies the rotational part of Newton's correction of each unreduced body as
/// a finite rotation, without strain: a linear one by theta stretches the body
/// by theta^2 / 2, too much for stiff directions.
///
/// Equation   d + (exp(theta) - 1 - theta x) (x + u - p),
///            theta = spread sum_i R y_i x d_i
/// @param state at which the correction was computed
/// @param d_H the correction, ordered as SystemState::u_H [m]
void turn_corrections(const SystemModel& model, const SystemState& state,
                      Eigen::Ref<VectorX> d_H);

}  // namespace limber::dynamics
