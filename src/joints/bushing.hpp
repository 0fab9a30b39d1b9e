// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "joints/motion.hpp"

namespace limber::joints {

/// Six-component elastic and viscous connection of two frames; joints are
/// bushings with some directions left free.
///
/// Equation   V = p' Kt p / 2 + p' Kc s + tr(D (I - R_FM)),
///            D = tr(Kr) I / 2 - Kr,  s = sin(theta) e of R_FM = Rot(e, theta).
///            For small angles s = theta e and V is the quadratic form of
///            [Kt Kc; Kc' Kr]; at any angle it is not less than this form of
///            (p, s). The chordal form has no singular angle, and with Kr e = 0
///            about an axis e the motion about e is exactly free through any
///            number of turns. Dissipation: the quadratic form of
///            [Ct Cc; Cc' Cr] in (v, w).
///            Along an axis that no stiffness holds the wrench is what damping
///            has there, exactly: what is left of the stiffness and damping of
///            other directions is round-off of the wrench, not of them. Values
///            below 1e-14 of a matrix's largest are zero.
/// Source     chordal (trace) potential: [@bullo1999, eq. 8]
/// Limits     a stiff rotation of pi from rest is an unstable equilibrium.
class Bushing {
 public:
  /// In F. Both 6 x 6 matrices symmetric, positive semi-definite.
  struct Parameters {
    Matrix3 translational_stiffness = Matrix3::Zero();  ///< Kt [N/m]
    Matrix3 rotational_stiffness = Matrix3::Zero();     ///< Kr [N m/rad]
    Matrix3 translational_damping = Matrix3::Zero();    ///< Ct [N s/m]
    Matrix3 rotational_damping = Matrix3::Zero();       ///< Cr [N m s/rad]
    /// Kc, Cc: force by rotation, and transposed moment by translation [N/rad],
    /// [N s/rad].
    Matrix3 coupling_stiffness = Matrix3::Zero();
    Matrix3 coupling_damping = Matrix3::Zero();
  };

  /// @throws InputError if a 6 x 6 matrix is not finite, symmetric and positive
  /// semi-definite.
  explicit Bushing(const Parameters& parameters);

  [[nodiscard]] const Parameters& parameters() const { return parameters_; }
  [[nodiscard]] CouplerResponse evaluate(const RelativeMotion& motion) const;

 private:
  void add_coupling(const RelativeMotion& motion,
                    CouplerResponse& response) const;

  // A symmetric matrix as sum_i values_i axes_i axes_i'.
  struct PrincipalForm {
    explicit PrincipalForm(const Matrix3& m);
    [[nodiscard]] Vector3 apply(const Vector3& x) const {
      return axes * values.cwiseProduct(axes.transpose() * x);
    }
    Vector3 values;
    Matrix3 axes;
  };

  // A direction that no stiffness holds, and the damping along or about it.
  struct FreeAxis {
    Vector3 axis;
    double damping;
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

}  // namespace limber::joints
