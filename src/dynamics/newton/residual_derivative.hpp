// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "dynamics/newton_matrix.hpp"
#include "dynamics/residual.hpp"

namespace limber::dynamics {

/// The exact derivative of a step's residual, as a map on increments.
///
/// Equation   for increments x of NewtonMatrix, with the wrenches held,
///            dq = x, dv = velocity T x, dvdot = acceleration T x, T the
///            inverse right Jacobian of a rotation increment, else 1:
///            residual = d r(q, v, vdot),   laws = d law(q, v)
///            with all derivatives of the inertia terms, of frames and arms
///            through which couplers, transmissions and loads act, and of
///            their laws.
/// Source     product rule on equations.cpp, kinematics.cpp, coupler_forces.cpp
/// Limits     nodes of unreduced bodies keep their tangent in NewtonMatrix:
///            their rows have what NewtonMatrix has, and frames on them are
///            taken to move without change of their arms.
class ResidualDerivative {
 public:
  explicit ResidualDerivative(const SystemModel& model);

  /// The point to differentiate at: all are kept by reference.
  /// @param acceleration that the residual was made with
  /// @param rotation_increments of the step, one a body [rad]
  void set_point(const SystemState& state, const SystemTerms& terms,
                 const Rates& acceleration,
                 const std::vector<Vector3>& rotation_increments,
                 const NewtonMatrix::Coefficients& coefficients);

  /// What `increments` change, beyond what the factors of NewtonMatrix have if
  /// they are of the same point: small where Newton's method with them is
  /// fast. No large stiffness is in it.
  /// @param residual sized as `increments`; zero for nodes
  /// @param laws of wrenches, one a coupler, then one a transmission, whose
  /// force is the first entry
  void apply_rest(const VectorX& increments, VectorX& residual,
                  std::vector<Vector6>& laws);

 private:
  // Change of an attachment's frame, world axes.
  struct FrameChange {
    Vector3 p = Vector3::Zero(), phi = Vector3::Zero();
    Vector3 v = Vector3::Zero(), w = Vector3::Zero();
  };
  // Change of a coupler's relative motion: translation over rotation.
  struct MotionChange {
    Vector6 position = Vector6::Zero(), velocity = Vector6::Zero();
  };

  void change_inertia(std::size_t b, const VectorX& x, VectorX& r) const;
  void change_frames(const VectorX& x);
  [[nodiscard]] FrameChange change_frame(const Attachment& attachment,
                                         const AttachmentMotion& motion,
                                         const VectorX& x) const;
  [[nodiscard]] FrameChange change_nodal_frame(const Attachment& attachment,
                                               const AttachmentMotion& motion,
                                               const VectorX& x) const;
  [[nodiscard]] MotionChange relate(const Coupler& coupler,
                                    const CouplerTerms& terms) const;
  // Adds what a wrench on an attachment, world axes, changes of the forces on
  // its body: by turning with the increments and by a change of its own.
  void change_wrench(AttachmentIndex attachment, const Vector3& force,
                     const Vector3& moment, const Vector3& d_force,
                     const Vector3& d_moment, const VectorX& x,
                     VectorX& r) const;
  void change_pair(const Coupler& coupler, const CouplerTerms& terms,
                   const MotionChange& change, const Vector6& wrench,
                   const Vector6& d_wrench, const VectorX& x, VectorX& r) const;
  void change_couplers(const VectorX& x, VectorX& r,
                       std::vector<Vector6>& laws);
  void change_path(const PathCoordinate& path, const TransmissionTerms& terms,
                   const VectorX& x, VectorX& r, Vector6& law) const;
  void change_sum(const JointSum& sum, const TransmissionTerms& terms,
                  const VectorX& x, VectorX& r, Vector6& law) const;
  void change_load(const Load& load, const VectorX& x, VectorX& r) const;
  void change_body_load(const BodyLoad& load, const VectorX& x,
                        VectorX& r) const;

  const SystemModel& model_;
  const SystemState* state_ = nullptr;
  const SystemTerms* terms_ = nullptr;
  const Rates* acceleration_ = nullptr;
  const std::vector<Vector3>* rotation_increments_ = nullptr;
  NewtonMatrix::Coefficients c_;
  std::vector<FrameChange> frames_;
  std::vector<MotionChange> motions_;
};

}  // namespace limber::dynamics
