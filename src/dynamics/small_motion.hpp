// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "dynamics/system_model.hpp"
#include "dynamics/system_state.hpp"

namespace limber::dynamics {

/// Axes in which small motion is told: turned by R from the world's now, and
/// turning on at w.
struct TurningAxes {
  Matrix3 R = Matrix3::Identity();
  Vector3 w_W = Vector3::Zero();  ///< [rad/s]
};

/// Small motion of a system about a motion of it, linearised.
///
/// Equation   M x'' + D x' + S x = 0,
///            S = diag(lambda) + G' K G + rest,
///            x: of each body that moves the change of its place and its turn,
///            both in the axes, and its modes. From the equations of motion's
///            derivatives M, C, K_q by accelerations, velocities, positions,
///            with x'_v = x' + w x, W = skew(w) on places and turns and
///            V = skew(w) on places, skew(w - w_b) on turns of a body at w_b:
///            D = C + M (W + V),   S = K_q + C W + M V W
/// Source     product rule; derivatives as ResidualDerivative has them
/// Limits     no bodies at level `full`
struct SmallMotion {
  MatrixX M;       ///< symmetric, positive definite
  MatrixX D;       ///< dampers, and gyroscopic terms
  VectorX lambda;  ///< of modes, 0 of places and turns [1/s^2]
  MatrixX G;       ///< motion of couplers, then transmissions: six rows each
  std::vector<Matrix6> K;  ///< their stiffness, one for six rows
  MatrixX rest;            ///< of forces that turn, and of inertia
  MatrixX noise;           ///< what round-off of couplers' wrenches adds to it
  std::vector<Eigen::Index> places;  ///< first of a body's six, -1: it rests
  std::vector<Eigen::Index> modes;   ///< first of a body's modes

  [[nodiscard]] Eigen::Index size() const { return M.rows(); }
  /// Q' S Q, products first, so that soft motion in Q keeps its digits beside
  /// stiff couplers.
  [[nodiscard]] MatrixX project_stiffness(const MatrixX& Q) const;
  /// What holds, whatever its stiffness: x is held if a row times x is not 0.
  [[nodiscard]] MatrixX find_holds() const;
};

/// About the motion that the system goes on with from `state`, loads after a
/// jump then.
/// @throws InputError for a body at level `full`.
[[nodiscard]] SmallMotion find_small_motion(const SystemModel& model,
                                            const SystemState& state,
                                            const TurningAxes& axes = {});

}  // namespace limber::dynamics
