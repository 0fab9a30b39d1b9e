// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "dynamics/full_factor.hpp"
#include "dynamics/workspace.hpp"

namespace limber::dynamics {

/// One reduced body's block D of NewtonMatrix, rows and columns translation
/// (world axes), rotation (body axes), modes: its modal block is diagonal, so
/// that D^-1 costs O(modes).
///
/// Equation   D = [c m, 0, 0; 0, S, c H; 0, c H' T, c + v zeta + lambda],
///            S = (c J + v (w x J - (J w) x)) T; c, v: derivatives of the end's
///            acceleration and velocity, T: of the step's rotation
class BodyFactor {
 public:
  using Coefficients = FullFactor::Coefficients;

  explicit BodyFactor(int modes);

  /// @param w angular velocity, body axes [rad/s]
  /// @throws NumericalError naming the body.
  void update(const BodyModel& body, const BodyTerms& terms, const Vector3& w,
              const Matrix3& T, const Coefficients& c);

  /// x := D^-1 x, 6 + modes numbers; rigid motion that the body has not is 0.
  void solve(double* x) const;
  /// Rows of the result: D^-1 times the rows of G, each 6 + modes long.
  void solve_rows(const Matrix6X& G, Matrix6X& result) const;

  /// D itself, six rows and columns at a time, filled up with those of the
  /// identity; of a body without rigid motion, they stand for that, too.
  [[nodiscard]] Matrix6 block(int row, int column) const;
  [[nodiscard]] int block_count() const {
    return 1 + (static_cast<int>(inverse_modes_.size()) + 5) / 6;
  }

 private:
  double inverse_mass_ = 0.0;  // of the translation block, 0 if clamped
  Matrix3 rotation_ = Matrix3::Identity();      // S
  Matrix3 inverse_rotation_ = Matrix3::Zero();  // of the Schur complement
  Matrix3X coupling_;                           // c H
  Matrix3X back_coupling_;                      // (c H' T)'
  VectorX inverse_modes_;                       // of the modal block
};

}  // namespace limber::dynamics
