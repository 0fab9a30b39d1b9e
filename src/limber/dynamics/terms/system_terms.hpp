// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "limber/dynamics/system/system_model.hpp"
#include "limber/dynamics/terms/kinematics.hpp"
#include "limber/dynamics/terms/mean_frame.hpp"
#include "limber/joints/coordinates/motion.hpp"
#include "limber/joints/coordinates/scalar_motion.hpp"

namespace limber::dynamics {

/// One body's part of the equations of motion at a state.
///
/// Equation   mass v'                = f_W
///            J w' + H eta''         = t_B - bias_r
///            H' w' + eta''          = q - bias_e
struct BodyTerms {
  Matrix3 R_WB;             ///< [-]
  Matrix3 J;                ///< inertia at the level's fidelity [kg m^2]
  Vector3 bias_r;           ///< Jdot w + w x (J w + H etadot) [N m]
  VectorX bias_e;           ///< inertial, damping and elastic terms [kg^-1/2 N]
  Vector3 force_W;          ///< resultant of loads and couplers [N]
  Vector3 moment_B;         ///< about Bo [N m]
  VectorX modal_force;      ///< m [kg^-1/2 N]
  double supplied = 0.0;    ///< power of loads and gravity on it [W]
  double received = 0.0;    ///< of couplers and pairs on it [W]
  double dissipated = 0.0;  ///< by its damping [W]
  /// m x m derivative of the elastic force by the modes, for NewtonMatrix,
  /// which fills it but over a step; empty if elasticity is diagonal
  /// [rad^2/s^2].
  MatrixX stiffness;
  /// Of Maxwell elements over the step, relative to the elastic one; set by
  /// integrators, else 0 [-].
  double maxwell_stiffness = 0.0;
  /// p x 12, p = m rounded up to four, columns: six of dJ/deta [kg^1/2 m],
  /// three of H, three of beta etadot [kg^1/2 m/s]; zero below level coupled.
  Eigen::Matrix<double, Eigen::Dynamic, 12> by_mode;
  /// 3 x m, sum_k eta_k beta_kl [kg^1/2 m].
  [[nodiscard]] auto H() const {
    return by_mode.middleCols<3>(6).topRows(modal_force.size()).transpose();
  }
  [[nodiscard]] Vector6 dJ(int mode) const {
    return by_mode.row(mode).head<6>().transpose();
  }
  [[nodiscard]] Vector3 beta_rate(int mode) const {
    return by_mode.row(mode).tail<3>().transpose();
  }
};

/// An unreduced body at a state, home frame.
///
/// Equation   M u'' = force - internal
struct FullTerms {
  std::unique_ptr<flexbody::FullBodySolver> solver;
  Matrix3X internal;           ///< 3 x N internal forces [N]
  Matrix3X force;              ///< 3 x N of loads, couplers and damping [N]
  double strain_energy = 0.0;  ///< [J]
  MeanFrame frame;             ///< if the model needs it
  /// m, of the damped modes [kg^1/2 m/s], then their damping [kg^-1/2 N].
  VectorX modal_rate;
  Matrix3X scratch;  ///< 3 x N [m/s, kg m/s, kg m or N]
};

/// One coupler at a state.
struct CouplerTerms {
  joints::RelativeMotion motion;
  joints::CouplerResponse response;
  /// The acting wrench, like response.wrench: the law's, or Newton's iterate
  /// [N, N m].
  Vector6 applied = Vector6::Zero();
  double received = 0.0;  ///< power of the bodies that it joins on it [W]
  int ideal = -1;  ///< index into SystemTerms::constraints of an ideal joint
};

/// One transmission at a state.
struct TransmissionTerms {
  joints::ScalarMotion motion;
  joints::ScalarResponse response;  ///< of all its laws
  /// The acting force, like response's [N or N m].
  double applied = 0.0;
  double received = 0.0;  ///< power of the bodies that it joins on it [W]
  /// Derivatives of the coordinate: of a path, with respect to each point in
  /// the world frame, over zeros [-]; of a sum, with respect to the increments
  /// of CouplerResponse of each coupler [unit of z / m, unit of z / rad].
  std::vector<Vector6> gradients;
};

/// Pair interactions at a state.
struct PairTerms {
  std::vector<std::size_t> members;      ///< bodies that have pairs
  std::vector<joints::PairBody> bodies;  ///< of all, members filled; the world
  std::vector<joints::PairResponse> responses;  ///< one a pair
};

/// One body's coordinates for pairs, where they are not only its modes: at
/// level nonlinear with products of modes (flexbody/model/mode_products.hpp),
/// at level full those of nodes (PairMotion). All empty at other levels, and
/// where nothing acts on points or nodes.
struct ProductTerms {
  /// Forces on products, of points, nodal loads and gravity; included in
  /// modal_force [kg^-1 m^-1 N].
  VectorX force;
  VectorX eta;     ///< of modes, then products [kg^1/2 m; kg m^2]
  VectorX etadot;  ///< likewise [kg^1/2 m/s; kg m^2/s]
};

/// Which wrench couplers exert on their bodies.
enum class WrenchSource { law, iterate };

/// Everything computed at one state. Sized once by make_terms, refilled without
/// allocation.
struct SystemTerms {
  std::vector<BodyTerms> bodies;              ///< by calc_inertia_terms
  std::vector<FullTerms> full;                ///< by both
  std::vector<AttachmentMotion> attachments;  ///< by calc_forces
  /// Of attachments on unreduced bodies; by calc_forces.
  std::vector<NodalFrameMotion> nodal_frames;
  [[nodiscard]] const NodalFrameMotion& nodal_frame(
      const AttachmentMotion& motion) const {
    return nodal_frames[static_cast<std::size_t>(motion.nodal)];
  }
  std::vector<CouplerTerms> couplers;  ///< by calc_forces
  /// Of ideal joints; by calc_forces. Over a step the gap is that at its end.
  std::vector<joints::ConstraintGap> constraints;
  std::vector<TransmissionTerms> transmissions;  ///< by calc_forces
  PairTerms pairs;                               ///< by calc_forces
  std::vector<ProductTerms> products;            ///< one a body, by calc_forces
};

}  // namespace limber::dynamics
