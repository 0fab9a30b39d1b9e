// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "limber/dynamics/system/system_state.hpp"

/// Motion of a body's stored nodes for many states at once: a dense product
/// over blocks of states, near memory bandwidth. Column j belongs to states[j],
/// row 3 i + c to component c of node i of ReducedBody::rows.
namespace limber::dynamics {

/// Coordinates in which the stress of a reduced body is linear: its modes
/// [kg^1/2 m] and, at level `nonlinear`, their products [kg m^2], times the
/// static stiffness of its material, with the stress of Maxwell elements.
/// @param out count_coordinates(body)
void calc_stress_coordinates(const BodyModel& body, const SystemState& state,
                             VectorX& out);

/// Deformations in the body frame, 3n x K [m].
///
/// Equation   u_B = Phi_B eta
/// @throws ContractError for a body without nodes, or sizes that differ.
void calc_node_deformations(const SystemModel& model, BodyIndex body,
                            std::span<const SystemState> states,
                            Eigen::Ref<MatrixX> u_B);

/// Positions in the world, 3n x K [m].
///
/// Equation   p_WP = p_WB + R_WB (x_B + Phi_B eta)
/// @throws as calc_node_deformations.
void calc_node_positions(const SystemModel& model, BodyIndex body,
                         std::span<const SystemState> states,
                         Eigen::Ref<MatrixX> p_WP);

/// Displacements in the world relative to the undeformed nodes with the body's
/// frame at X_WB0, 3n x K [m].
///
/// Equation   u_W = p_WP - (p_WB0 + R_WB0 x_B)
/// @throws as calc_node_deformations.
void calc_node_displacements(const SystemModel& model, BodyIndex body,
                             std::span<const SystemState> states,
                             const Pose& X_WB0, Eigen::Ref<MatrixX> u_W);

}  // namespace limber::dynamics
