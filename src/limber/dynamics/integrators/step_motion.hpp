// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/terms/system_terms.hpp"

/// Mean velocities over a step that take positions from one end to the other
/// exactly, and with which the work of forces is exactly the change of stored
/// energy.
///
/// Equation   with the mean A = (A_0 + A_1) / 2 of values at both ends, and dA
/// =
///            A_1 - A_0, a body rotates by R_1 = R_0 cay(h w_B), so that
///            dR = h w_W x R, w_W = R_0 w_B, and its frames have
///            p_F1 = p_F0 + h v_F,   v_F = v + w_W x (p_F - p) + R^-T Phi eta',
///            R_F1 = cay(h w_F) R_F0, w_F = w_W + T Psi eta'.
///            A force and a moment at a frame are (p_F - p) x f + M on the
///            body about Bo and Phi' R^-1 f + Psi' T' M on its modes, in world
///            axes: their power is that in v_F and w_F, and pairs of them have
///            no moment about any point.
///            For a coupler, p_FM1 = p_FM0 + h v_FM, R_FM1 = cay(h w_FM)
///            R_FM0, v_FM = R_F' (v_M - v_F - w_F x (p_M - p_F)),
///            w_FM = R_F^-1 (w_M - w_F) / (1 + h^2 w_F . w_M / 4).
/// Source     Cayley's transform: [@simo1991], composed by Rodrigues'
///            formula; the rest follows from d(AB) = dA B + A dB.
namespace limber::dynamics {

struct BodyStep {
  Vector3 rotation;  ///< h w_B, vector of Cayley's transform [-]
  Vector3 v_W;       ///< [m/s]
  Vector3 w_W;       ///< [rad/s]
  Matrix3 R_WB;      ///< mean of both ends, not a rotation [-]
  Matrix3 dual_R;  ///< its inverse transposed, R_0 (I + skew(rotation) / 2) [-]
  /// The rotation halfway between both ends [-].
  Matrix3 middle_R_WB;
};

struct FrameStep {
  Matrix3 R_WF;   ///< mean of both ends, not a rotation [-]
  Vector3 p_WF;   ///< mean of both ends [m]
  Vector3 arm_W;  ///< p_WF - p_WB, mean of both ends [m]
  Vector3 v_W;    ///< [m/s]
  Vector3 w_W;    ///< [rad/s]
  Matrix3 twist;  ///< T; for a frame on a flexible body only [-]
};

struct CouplerStep {
  joints::RelativeMotion mean;  ///< as joints::MotionStep::mean
  Vector3 arm_W;                ///< p_M - p_F [m]
  Matrix3 force_R;   ///< maps the force conjugate to v_FM to the world [-]
  Matrix3 moment_R;  ///< maps the moment conjugate to w_FM to the world [-]
};

struct StepMotion {
  double h = 0.0;  ///< [s]
  std::vector<BodyStep> bodies;
  std::vector<FrameStep> frames;  ///< one per attachment
  std::vector<CouplerStep> couplers;
};

[[nodiscard]] StepMotion make_step_motion(const SystemModel& model);

/// Fills the motion of bodies that are not at level `full`.
/// @param begin, end at both ends, with their evaluated terms
/// @param middle with the mean velocities v_WB_W, w_WB_B and etadot that took
/// `begin` to `end`
/// @param h length of the step [s]
void calc_step_motion(const SystemModel& model, const SystemState& begin,
                      const SystemState& middle, const SystemState& end,
                      const SystemTerms& begin_terms,
                      const SystemTerms& end_terms, double h,
                      StepMotion& motion);

}  // namespace limber::dynamics
