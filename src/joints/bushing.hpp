// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "joints/motion.hpp"

namespace limber::joints {

/// Six-component elastic and viscous connection of two frames; joints are
/// bushings with some directions left free.
///
/// Equation   V = p' Kt p / 2 + tr(D (I - R_FM)),  D = tr(Kr) I / 2 - Kr.
///            For small angles V = theta' Kr theta / 2; the chordal form has
///            no singular angle, and with Kr e = 0 about an axis e the motion
///            about e is exactly free through any number of turns.
///            Dissipation v' Ct v + w' Cr w.
/// Source     chordal (trace) potential: Bullo and Murray, "Tracking for
///            fully actuated mechanical systems", Automatica 35, 1999, eq. 8.
/// Limits     a stiff rotation of pi from rest is an unstable equilibrium.
class Bushing {
 public:
  /// Symmetric, positive semi-definite; in F.
  struct Parameters {
    Matrix3 translational_stiffness = Matrix3::Zero();  ///< Kt [N/m]
    Matrix3 rotational_stiffness = Matrix3::Zero();     ///< Kr [N m/rad]
    Matrix3 translational_damping = Matrix3::Zero();    ///< Ct [N s/m]
    Matrix3 rotational_damping = Matrix3::Zero();       ///< Cr [N m s/rad]
  };

  /// @throws InputError if a matrix is not finite, symmetric and positive
  /// semi-definite.
  explicit Bushing(const Parameters& parameters);

  [[nodiscard]] const Parameters& parameters() const { return parameters_; }
  [[nodiscard]] CouplerResponse evaluate(const RelativeMotion& motion) const;

 private:
  Parameters parameters_;
  Matrix3 D_;  ///< tr(Kr) I / 2 - Kr [N m]
};

}  // namespace limber::joints
