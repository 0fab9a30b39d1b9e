// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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

  Parameters parameters_;
  Matrix3 D_;        ///< tr(Kr) I / 2 - Kr [N m]
  bool is_coupled_;  ///< Kc is not zero
};

}  // namespace limber::joints
