// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "dynamics/mean_frame.hpp"

namespace limber::dynamics {

/// Where a turning unreduced body's nodes are after a step in which it moves as
/// a rigid body: where Newton's method begins. Nodes that go straight on, as
/// their inertia has it, stretch a body that turns by theta by theta^2 / 2; the
/// stiff motion along a slender one, which no step resolves, then takes
/// Newton's method far off.
///
/// Equation   x + u <- p + h p' + s h^2 p'' + exp(h w + s h^2 w') (x + u - p);
///            p'' + w' x (c - p) + w x (w x (c - p)) = mean of u'',
///            w' = spread sum_i R y_i x (u''_i - w x (w x (x_i + u_i - p)))
/// @param uddot_H nodal accelerations, as SystemState::u_H [m/s^2]
/// @param s share of h^2, 1/2 of an exact integral [-]
/// @param u_H the nodes' displacements, 3 x N [m]
/// @returns whether the body turns by more than 0.01 rad; if not, nothing is
/// written.
bool predict_turned_nodes(const SystemModel& model, const FullModel& full,
                          const SystemState& from, const VectorX& uddot_H,
                          double h, double s, Nodes u_H);

/// Newton's correction of an unreduced body with its share of rotation as a
/// rotation, which strains nothing: the linear one by theta stretches the body
/// by theta^2 / 2, too much for what is stiff.
///
/// Equation   d + (exp(theta) - 1 - theta x) (x + u - p),
///            theta = spread sum_i R y_i x d_i
/// @param state where the correction was solved for
/// @param d_H the correction, 3 x N, as SystemState::u_H [m]
void turn_correction(const SystemModel& model, const FullModel& full,
                     const SystemState& state, Nodes d_H);

}  // namespace limber::dynamics
