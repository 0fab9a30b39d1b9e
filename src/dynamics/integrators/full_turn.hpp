// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "dynamics/mean_frame.hpp"

namespace limber::dynamics {

/// A step as Newmark has it, a and a_next mean accelerations of its ends:
/// u + h u' + h^2 (lag a + beta a_next).
struct NewmarkStep {
  double h = 0.0;     ///< [s]
  double lag = 0.0;   ///< [-]
  double beta = 0.0;  ///< [-]
};

/// Accelerations that take a turning unreduced body's nodes where they are
/// after a step in which it moves as a rigid body: where Newton's method
/// begins. Nodes that go straight on, as their inertia has it, stretch a body
/// that turns by theta by theta^2 / 2; the stiff motion along a slender one,
/// which no step resolves, then takes Newton's method far off.
///
/// Equation   x + u <- p + h p' + s h^2 p'' + exp(h w + s h^2 w') (x + u - p);
///            p'' + w' x (c - p) + w x (w x (c - p)) = mean of u'',
///            w' = spread sum_i R y_i x (u''_i - w x (w x (x_i + u_i - p)))
///            s = lag + beta
/// @param uddot_H nodal accelerations, as SystemState::u_H [m/s^2]
/// @param a_H the step's a, likewise
/// @param a_next_H its a_next; only those of bodies that turn by more than 0.01
/// rad are written
/// @returns whether one does
bool predict_turns(const SystemModel& model, const SystemState& from,
                   const VectorX& uddot_H, const VectorX& a_H,
                   const NewmarkStep& step, VectorX& a_next_H);

/// Newton's correction of each unreduced body with its share of rotation as a
/// rotation, which strains nothing: the linear one by theta stretches the body
/// by theta^2 / 2, too much for what is stiff.
///
/// Equation   d + (exp(theta) - 1 - theta x) (x + u - p),
///            theta = spread sum_i R y_i x d_i
/// @param state where the correction was solved for
/// @param d_H the correction, as SystemState::u_H [m]
void turn_corrections(const SystemModel& model, const SystemState& state,
                      Eigen::Ref<VectorX> d_H);

}  // namespace limber::dynamics
