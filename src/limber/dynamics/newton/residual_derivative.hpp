// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/newton/newton_matrix.hpp"

namespace limber::dynamics {

/// The exact derivative of a step's residual, as a map on increments.
///
/// Equation   for increments x of NewtonMatrix, at constant wrenches,
///            dq = x, dv = velocity T x, dvdot = acceleration T x, T the
///            inverse right Jacobian of a rotation increment, else 1:
///            residual = d r(q, v, vdot),   laws = d law(q, v)
///            with all derivatives of the inertia terms, of frames and arms of
///            couplers, transmissions, pairs and loads, and of their laws; the
///            points of pairs are treated as fixed in their bodies.
/// Source     product rule applied to equations.cpp, kinematics.cpp,
///            coupler_forces.cpp
/// Limits     nodes of unreduced bodies have only the tangent of NewtonMatrix:
///            arms of frames on them are treated as constant.
class ResidualDerivative {
 public:
  explicit ResidualDerivative(const SystemModel& model);

  /// The point to differentiate at, stored by reference.
  /// @param acceleration of the residual
  /// @param motion of the step, whose rotations count [rad]
  void set_point(const SystemState& state, const SystemTerms& terms,
                 const VectorX& acceleration, const VectorX& motion,
                 const NewtonMatrix::Coefficients& coefficients);

  /// Change by `increments` beyond that of NewtonMatrix factored at the same
  /// point: small where Newton's method with it converges fast. Contains no
  /// large stiffness.
  /// @param residual sized as `increments`; zero for nodes
  /// @param laws of wrenches, one per coupler, then one per transmission, whose
  /// force is the first entry
  void apply_rest(const VectorX& increments, VectorX& residual,
                  std::vector<Vector6>& laws);

  /// Change of an attachment's frame, world frame.
  struct FrameChange {
    Vector3 p = Vector3::Zero(), phi = Vector3::Zero();  ///< [m], [rad]
    Vector3 v = Vector3::Zero(), w = Vector3::Zero();    ///< [m/s], [rad/s]
  };
  /// Of the last apply_rest.
  [[nodiscard]] const FrameChange& frame_change(AttachmentIndex i) const {
    return frames_[static_cast<std::size_t>(i)];
  }

 private:
  // Change of a coupler's relative motion: translation over rotation
  // [m, rad] and their rates [m/s, rad/s].
  struct MotionChange {
    Vector6 position = Vector6::Zero(), velocity = Vector6::Zero();
  };

  // Bodies that do not move, such as all but one for a unit vector, cost
  // nothing.
  void find_moved(const VectorX& x);
  [[nodiscard]] bool is_moved(AttachmentIndex attachment) const;
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
  // Adds the change of the forces on a body by a wrench on an attachment, world
  // frame: by its rotation with the increments and by its own change.
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
  void change_pairs(const VectorX& x, VectorX& r) const;
  void change_load(const Load& load, const VectorX& x, VectorX& r) const;
  void change_body_load(const BodyLoad& load, const VectorX& x,
                        VectorX& r) const;

  const SystemModel& model_;
  const SystemState* state_ = nullptr;
  const SystemTerms* terms_ = nullptr;
  const VectorX* acceleration_ = nullptr;
  const VectorX* motion_ = nullptr;
  NewtonMatrix::Coefficients c_;
  std::vector<char> is_moved_;  // by body
  std::vector<FrameChange> frames_;
  std::vector<MotionChange> motions_;
};

}  // namespace limber::dynamics
