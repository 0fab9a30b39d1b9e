// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "common/pose.hpp"
#include "dynamics/system_model.hpp"
#include "joints/coupler_memory.hpp"
#include "joints/motion.hpp"

namespace limber::dynamics {

/// Rigid motion of one body's frame B. Of a body at level `full`, the mean-axis
/// frame of its nodes at the last output; the nodes are what moves.
struct BodyState {
  Vector3 p_WB = Vector3::Zero();               ///< centre of mass [m]
  Quaternion quat_WB = Quaternion::Identity();  ///< unit
  Vector3 v_WB_W = Vector3::Zero();             ///< [m/s]
  Vector3 w_WB_B = Vector3::Zero();             ///< [rad/s], in B
};

/// All that moves. A plain value: copy it, store it, start from it.
struct SystemState {
  double t = 0.0;                 ///< [s]
  std::vector<BodyState> bodies;  ///< one a body
  VectorX eta;     ///< modal coordinates of all bodies [kg^1/2 m]
  VectorX etadot;  ///< [kg^1/2 m/s]
  /// Unreduced bodies, one after the other. Their home frames H rest in the
  /// world, by default where B is at the start: node i is at X_WH (x_i + u_i),
  /// so that no digits are lost on a position.
  std::vector<Pose> X_WH;
  VectorX u_H;     ///< nodal displacements [m]
  VectorX udot_H;  ///< nodal velocities [m/s]
  /// What couplers and then transmissions remember, one each; changes between
  /// steps alone.
  std::vector<joints::CouplerMemory> memory;
};

/// A state of the right size: every body at the world origin, at rest; joints'
/// angles without whole turns.
[[nodiscard]] SystemState make_state(const SystemModel& model);

/// Puts the nodes of each unreduced body where its BodyState and, in the modes
/// of the reduced body, `u_B` have them: home frames at X_WB, velocities those
/// of the rigid motion. For a new state, after the bodies' were set.
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
