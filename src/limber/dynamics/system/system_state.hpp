// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/common/evaluation_time.hpp"
#include "limber/common/pose.hpp"
#include "limber/dynamics/system/pair_memory.hpp"
#include "limber/dynamics/system/system_model.hpp"
#include "limber/joints/coordinates/motion.hpp"
#include "limber/joints/coupler_memory.hpp"

namespace limber::dynamics {

/// Rigid motion of one body's frame B. For a body at level `full`, the
/// mean-axis frame of its nodes at the last output; its state is that of the
/// nodes.
struct BodyState {
  Vector3 p_WB = Vector3::Zero();               ///< centre of mass [m]
  Quaternion quat_WB = Quaternion::Identity();  ///< unit [-]
  Vector3 v_WB_W = Vector3::Zero();             ///< [m/s]
  Vector3 w_WB_B = Vector3::Zero();             ///< [rad/s], in B
};

/// Data of a controller between samples. A plain value, part of the state.
struct ControllerState {
  /// Index of the next sample, at offset + next period; earlier ones are taken.
  long next = 0;
  std::vector<double> memory;  ///< its own [its own units]
};

/// State of a system. A plain value that can be copied and stored.
struct SystemState {
  double t = 0.0;                 ///< [s]
  std::vector<BodyState> bodies;  ///< one per body
  VectorX eta;     ///< modal coordinates of all bodies [kg^1/2 m]
  VectorX etadot;  ///< [kg^1/2 m/s]
  /// Extensions of Maxwell elements (flexbody/modal/maxwell_elements.hpp): for
  /// each body m x J by columns; 0 in equilibrium [kg^1/2 m].
  VectorX maxwell;
  /// Unreduced bodies, one after the other. Their home frames H are fixed in
  /// the world, by default at the initial B: node i is at X_WH (x_i + u_i), so
  /// that displacements keep their digits.
  std::vector<Pose> X_WH;
  VectorX u_H;     ///< nodal displacements [m]
  VectorX udot_H;  ///< nodal velocities [m/s]
  /// Memory of couplers and then transmissions, one each; changes only between
  /// steps.
  std::vector<joints::CouplerMemory> memory;
  /// One per input; changes only when a controller is sampled.
  std::vector<InputState> inputs;
  std::vector<ControllerState> controllers;  ///< one a controller
  /// Memory of pairs, one after the other; changes only at accepted steps.
  PairMemory pair_memory;
  /// For each pair 1 if its bodies do not touch: it then has no points in the
  /// next step, and is not evaluated; empty if unknown.
  std::vector<char> far_pairs;
};

/// The state's time and inputs, as functions of time need them.
[[nodiscard]] inline EvaluationTime now_of(const SystemState& state,
                                           Side side = Side::right) {
  return {state.t, side, state.inputs};
}

/// Copies what is constant within a step.
inline void copy_step_constants(const SystemState& from, SystemState& to) {
  to.memory = from.memory;
  to.inputs = from.inputs;
  to.controllers = from.controllers;
  to.pair_memory = from.pair_memory;
  to.far_pairs = from.far_pairs;
}

/// A state of the right size: every body at the world origin, at rest; joints'
/// angles without full turns; inputs and controllers at their initial values.
[[nodiscard]] SystemState make_state(const SystemModel& model);

/// Places the nodes of each unreduced body by its BodyState and `u_B`: home
/// frames at X_WB, velocities of the rigid motion plus `udot_B`. For a new
/// state, after its BodyStates are set.
/// @param u_B, udot_B as SystemState::u_H but in body frames; empty: zero
void place_nodes(const SystemModel& model, const VectorX& u_B,
                 const VectorX& udot_B, SystemState& state);

/// Refreshes the BodyState of unreduced bodies from their nodes.
void update_mean_frames(const SystemModel& model, SystemState& state);

/// Pose and velocity of an attachment's frame.
struct FrameMotion {
  Pose X_WF;
  Vector3 v_WF_W = Vector3::Zero();  ///< [m/s]
  Vector3 w_WF_W = Vector3::Zero();  ///< [rad/s]
};
[[nodiscard]] FrameMotion find_frame_motion(const SystemModel& model,
                                            const SystemState& state,
                                            AttachmentIndex attachment);

/// Motion of a coupler's frame M in its frame F.
[[nodiscard]] joints::RelativeMotion find_relative_motion(
    const SystemModel& model, const SystemState& state, CouplerIndex coupler);

}  // namespace limber::dynamics
