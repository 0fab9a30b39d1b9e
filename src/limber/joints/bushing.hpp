// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/joints/coordinates/motion.hpp"
#include "limber/joints/coupler_law_kind.hpp"

namespace limber::joints {

/// Six-component elastic and viscous connection of two frames; joints are
/// bushings with some directions free.
///
/// Equation   V = p' Kt p / 2 + p' Kc s + tr(D (I - R_FM)),
///            D = tr(Kr) I / 2 - Kr,  s = sin(theta) e of R_FM = Rot(e, theta).
///            For small angles s = theta e and V is the quadratic form of
///            [Kt Kc; Kc' Kr]; at any angle V is at least this form of (p, s).
///            The chordal form has no singular angle, and with Kr e = 0
///            about an axis e the motion about e is exactly free through any
///            number of turns. Dissipation: the quadratic form of
///            [Ct Cc; Cc' Cr] in (v, w).
///            Along an axis without stiffness the wrench is exactly that of
///            the damping there: round-off is relative to the wrench, not to
///            the stiffness and damping of other directions. Values below
///            1e-14 of a matrix's largest count as zero.
/// Source     chordal (trace) potential: [@bullo1999, eq. 8]
/// Limits     a rotation of pi from rest against a stiffness is an unstable
///            equilibrium.
class Bushing : public WithoutSwitches,
                public WithoutCoordinates,
                public WithoutCommands,
                public WithoutConstraint,
                public WithoutReadings {
 public:
  /// Expressed in F. Both 6 x 6 matrices are symmetric and positive
  /// semi-definite.
  struct Parameters {
    Matrix3 translational_stiffness = Matrix3::Zero();  ///< Kt [N/m]
    Matrix3 rotational_stiffness = Matrix3::Zero();     ///< Kr [N m/rad]
    Matrix3 translational_damping = Matrix3::Zero();    ///< Ct [N s/m]
    Matrix3 rotational_damping = Matrix3::Zero();       ///< Cr [N m s/rad]
    /// Kc, Cc: force per rotation; transposed, moment per translation.
    Matrix3 coupling_stiffness = Matrix3::Zero();  ///< [N/rad]
    Matrix3 coupling_damping = Matrix3::Zero();    ///< [N s/rad]
  };

  /// @throws InputError if a 6 x 6 matrix is not finite, symmetric and positive
  /// semi-definite.
  explicit Bushing(const Parameters& parameters);

  [[nodiscard]] const Parameters& parameters() const { return parameters_; }
  [[nodiscard]] CouplerResponse evaluate(const RelativeMotion& motion) const;
  [[nodiscard]] CouplerResponse evaluate(const RelativeMotion& motion,
                                         const CouplerMemory& /*memory*/,
                                         const EvaluationTime& /*now*/) const {
    return evaluate(motion);
  }
  /// The response at the mean motion: exact for a quadratic energy.
  [[nodiscard]] CouplerResponse evaluate_over_step(
      const MotionStep& motion, const CouplerMemory& /*memory*/,
      const StepTimes& /*times*/) const {
    return evaluate(motion.mean);
  }

  /// The coupling of translation and rotation adds none, since the matrices
  /// are positive semi-definite.
  [[nodiscard]] RequiredSides find_required_rotations() const;

 private:
  void add_coupling(const RelativeMotion& motion,
                    CouplerResponse& response) const;

  // A symmetric matrix as sum_i values_i axes_i axes_i'.
  struct PrincipalForm {
    explicit PrincipalForm(const Matrix3& m);
    [[nodiscard]] Vector3 apply(const Vector3& x) const {
      return axes * values.cwiseProduct(axes.transpose() * x);
    }
    Vector3 values;  // [unit of the matrix]
    Matrix3 axes;    // [-]
  };

  // A direction without stiffness, and the damping along or about it.
  struct FreeAxis {
    Vector3 axis;    // unit [-]
    double damping;  // [N s/m or N m s/rad]
  };
  static std::vector<FreeAxis> find_free_axes(const Matrix3& axes,
                                              const Eigen::Array3i& is_free,
                                              const PrincipalForm& damping);
  static Vector3 clear(const std::vector<FreeAxis>& free, const Vector3& rate,
                       const Vector3& force);

  Parameters parameters_;
  Matrix3 D_;  ///< tr(Kr) I / 2 - Kr [N m]
  PrincipalForm principal_D_;
  PrincipalForm principal_Kt_;
  PrincipalForm principal_Ct_;
  PrincipalForm principal_Cr_;
  std::vector<FreeAxis> free_translations_;  // none if coupled
  std::vector<FreeAxis> free_rotations_;
  bool is_coupled_;  ///< Kc is not zero
};

constexpr auto fields_of(const Bushing::Parameters*) {
  return list_fields(
      "bushing", "translational stiffness [N/m]",
      "rotational stiffness [N m/rad]", "translational damping [N s/m]",
      "rotational damping [N m s/rad]", "coupling stiffness [N/rad]",
      "coupling damping [N s/rad]");
}

/// Stiffness and deflection of a joint's constrained directions. The distance
/// is that in constrained directions; the rotation is the angle about the
/// stiffest axis that stores the same energy.
[[nodiscard]] ConstraintStiffness find_constraint_stiffness(
    const Bushing& constraint);
/// Deflection p, sin(theta) e. @throws ContractError unless both stiffnesses
/// are multiples of projections, uncoupled.
[[nodiscard]] ConstraintGap find_constraint_gap(const Bushing& constraint,
                                                const RelativeMotion& motion);
[[nodiscard]] ConstraintDeflection find_deflection(
    const Bushing& constraint, const ConstraintStiffness& stiffness,
    const RelativeMotion& motion);

}  // namespace limber::joints
