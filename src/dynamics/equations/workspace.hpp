// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "dynamics/kinematics.hpp"
#include "dynamics/mean_frame.hpp"
#include "dynamics/system_model.hpp"
#include "joints/motion.hpp"
#include "joints/scalar_motion.hpp"

namespace limber::dynamics {

/// One body's part of the equations of motion at a state.
///
/// Equation   mass v'                = f_W
///            J w' + H eta''         = t_B - bias_r
///            H' w' + eta''          = q - bias_e
struct BodyTerms {
  Matrix3 R_WB;
  Matrix3 J;            ///< inertia at the level's fidelity [kg m^2]
  Matrix3X H;           ///< 3 x m, sum_k eta_k beta_kl
  Vector3 bias_r;       ///< Jdot w + w x (J w + H etadot) [N m]
  VectorX bias_e;       ///< inertial, damping and elastic terms
  Vector3 force_W;      ///< resultant of loads and couplers [N]
  Vector3 moment_B;     ///< about Bo [N m]
  VectorX modal_force;  ///< m
  VectorX scratch_J2;   ///< 6m: J2 eta
  VectorX scratch_b1;   ///< 3m: beta eta
  VectorX scratch_b2;   ///< 3m: beta etadot
};

/// An unreduced body at a state, home axes.
///
/// Equation   M u'' = force - internal
struct FullTerms {
  std::unique_ptr<flexbody::FullBodySolver> solver;
  Matrix3X internal;           ///< 3 x N internal forces [N]
  Matrix3X force;              ///< 3 x N of loads, couplers and damping [N]
  double strain_energy = 0.0;  ///< [J]
  MeanFrame frame;             ///< if the model needs it
  VectorX modal_rate;          ///< m, of the damped modes
  Matrix3X scratch;            ///< 3 x N
};

/// One coupler at a state.
struct CouplerTerms {
  joints::RelativeMotion motion;
  joints::CouplerResponse response;
  /// The wrench that acts, like response.wrench: the law's own, or Newton's
  /// iterate of it.
  Vector6 applied = Vector6::Zero();
};

/// One transmission at a state.
struct TransmissionTerms {
  joints::ScalarMotion motion;
  joints::ScalarResponse response;  ///< of all its laws
  double applied = 0.0;             ///< the force that acts, like response's
  /// Derivatives of the coordinate: of a path by each point, world axes over
  /// zeros; of a sum by the increments of CouplerResponse of each coupler.
  std::vector<Vector6> gradients;
};

/// Which wrench couplers exert on their bodies.
enum class WrenchSource { law, iterate };

/// Everything that is computed at one state. Sized once, by make_terms;
/// refilled without allocation.
struct SystemTerms {
  std::vector<BodyTerms> bodies;                 ///< by calc_inertia_terms
  std::vector<FullTerms> full;                   ///< by both
  std::vector<AttachmentMotion> attachments;     ///< by calc_forces
  std::vector<CouplerTerms> couplers;            ///< by calc_forces
  std::vector<TransmissionTerms> transmissions;  ///< by calc_forces
  double load_power = 0.0;  ///< of loads, gravity, drives [W], calc_forces
  double dissipated_power = 0.0;  ///< couplers and modes [W], calc_forces
};

/// Accelerations of all bodies.
struct Accelerations {
  std::vector<Vector3> a_WB_W;   ///< [m/s^2]
  std::vector<Vector3> dw_WB_B;  ///< [rad/s^2]
  VectorX etaddot;
  VectorX uddot_H;  ///< [m/s^2]
};

[[nodiscard]] SystemTerms make_terms(const SystemModel& model);
[[nodiscard]] Accelerations make_accelerations(const SystemModel& model);

}  // namespace limber::dynamics
