// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/dynamics/system/system_model.hpp"
#include "limber/dynamics/system/system_state.hpp"

namespace limber::dynamics {

/// Axes in which small motion is expressed: orientation R in the world at the
/// state's time, angular velocity w.
struct TurningAxes {
  Matrix3 R = Matrix3::Identity();  ///< [-]
  Vector3 w_W = Vector3::Zero();    ///< [rad/s]
};

/// Small motion of a system linearised about a reference motion.
///
/// Equation   M x'' + D x' + S x + E' y = 0,  y' = E x' - y / tau,
///            S = diag(lambda) + coupled + G' K G + rest,
///            y: Maxwell elements of the modes, sqrt(lambda g) d,
///            x: for each moving body the changes of position and orientation,
///            expressed in the axes, and its modes. From the derivatives M, C,
///            K_q of the equations of motion by accelerations, velocities,
///            positions, with x'_v = x' + w x, W = skew(w) on positions and
///            rotations and V = skew(w) on positions, skew(w - w_b) on
///            rotations of a body at w_b:
///            D = C + M (W + V),   S = K_q + C W + M V W
/// Source     product rule; derivatives as ResidualDerivative has them
/// Limits     no bodies at level `full`
///
/// Columns are of x: positions [m], rotations [rad], modes [kg^1/2 m]. Rows of
/// M, D, `rest` and `noise` are forces [N], moments [N m] and modal forces
/// [kg^-1/2 N].
struct SmallMotion {
  MatrixX M;  ///< symmetric, positive definite [row's s^2 / column's]
  MatrixX D;  ///< dampers, and gyroscopic terms [row's s / column's]
  /// Of modes that are independent oscillators; 0 of all others [1/s^2].
  VectorX lambda;
  /// Elastic tangent of a body whose elasticity couples its modes.
  struct ModalBlock {
    Eigen::Index first = 0;  ///< column of its first mode
    MatrixX K;               ///< symmetric [1/s^2]
  };
  std::vector<ModalBlock> coupled;
  /// Motion of couplers, then transmissions, then points of pairs, whose last
  /// three are 0: six rows each [m or rad / column's].
  MatrixX G;
  std::vector<Matrix6>
      K;  ///< stiffness of these, one per six rows [N/m, N/rad; N, N m/rad]
  /// Damping of couplers and transmissions, likewise [N s/m, N s/rad; N s, N m
  /// s/rad].
  std::vector<Matrix6> damping;
  /// Velocities of couplers and transmissions by x and by x', rows as G
  /// [m/s or rad/s / column's, or its rate's].
  MatrixX velocities;
  MatrixX velocities_by_rate;
  /// For the requested frames, six rows each, translation first: motion in the
  /// world by x [m or rad], velocity by x and by x' [m/s or rad/s].
  MatrixX frames;
  MatrixX frame_velocities;
  MatrixX frame_velocities_by_rate;
  MatrixX rest;  ///< of rotating forces, and of inertia [row's / column's]
  /// Round-off of `rest` due to couplers' wrenches [row's / column's].
  MatrixX noise;
  /// One Maxwell element of all modes of a body: rows of E that are
  /// `weights` at the columns of its modes.
  struct Relaxation {
    Eigen::Index first = 0;  ///< column of the first mode
    VectorX weights;         ///< sqrt(lambda g) [1/s]
    double time = 0.0;       ///< tau [s]
  };
  std::vector<Relaxation> relaxations;
  std::vector<BodyIndex> bodies;  ///< whose motion it is
  std::vector<Eigen::Index>
      places;  ///< index of a body's first of six, -1: fixed
  std::vector<Eigen::Index> modes;  ///< index of a body's first mode

  [[nodiscard]] Eigen::Index size() const { return M.rows(); }
  /// Q' S Q, evaluated to preserve the digits of soft motion in Q beside stiff
  /// couplers.
  [[nodiscard]] MatrixX project_stiffness(const MatrixX& Q) const;
  /// Twice the strain energy of the bodies, of each column of Q.
  [[nodiscard]] VectorX project_strain(const MatrixX& Q) const;
  /// The diagonal of project_stiffness(Q), likewise.
  [[nodiscard]] VectorX project_squares(const MatrixX& Q) const;
  /// E Q, a row for each y.
  [[nodiscard]] MatrixX project_relaxations(const MatrixX& Q) const;
  /// 1 / tau of each y [1/s].
  [[nodiscard]] VectorX relaxation_rates() const;
  /// Constraint directions, independent of stiffness: x is constrained if a row
  /// times x is not 0.
  [[nodiscard]] MatrixX find_holds() const;
  /// From coordinates of the state (positions in the world frame, rotations in
  /// the body frames), with C in D and K_q without stiffness in `rest`.
  void express_in(const TurningAxes& axes, const SystemState& state);
};

/// Linearises about the motion of the system from `state`, with loads after a
/// jump at its time.
/// @param frames attachments whose motion is also requested
/// @throws InputError for a body at level `full`.
[[nodiscard]] SmallMotion find_small_motion(
    const SystemModel& model, const SystemState& state,
    const TurningAxes& axes = {},
    const std::vector<AttachmentIndex>& frames = {});

}  // namespace limber::dynamics
