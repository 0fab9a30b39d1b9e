// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "common/pose.hpp"
#include "dynamics/system_model.hpp"

namespace limber::dynamics {

/// Rigid motion of one body's frame B.
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
};

/// A state of the right size: every body at the world origin, at rest.
[[nodiscard]] SystemState make_state(const SystemModel& model);

/// Pose and velocity of an attachment's frame.
struct FrameMotion {
  Pose X_WF;
  Vector3 v_WF_W = Vector3::Zero();  ///< [m/s]
  Vector3 w_WF_W = Vector3::Zero();  ///< [rad/s]
};
[[nodiscard]] FrameMotion find_frame_motion(const SystemModel& model,
                                            const SystemState& state,
                                            AttachmentIndex attachment);

}  // namespace limber::dynamics
