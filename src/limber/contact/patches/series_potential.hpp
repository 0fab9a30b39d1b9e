// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/contact/potential/pair_potential.hpp"

namespace limber::contact {

/// Two bodies in series with flexible layers under the faces of each, which
/// move with them.
///
/// Equation   W_s(x) = min over f of W(x + R f) + f' R f / 2, R = R_A + R_B the
///            displacement of B against A by a force f on B; gradient that of W
///            there, Hessian K - K (1 + R K)^-1 R K, of displacements
/// Limits     the Hessian neglects the rotation of R with the bodies
class SeriesPotential {
 public:
  /// @param R_A, R_B of both layers, in their bodies' frames, symmetric and
  /// positive semidefinite [m/N]
  SeriesPotential(const PlacedBody& A, const PlacedBody& B, double modulus,
                  const Matrix3& R_A, const Matrix3& R_B);

  /// As PairPotential's. @throws NumericalError if Newton's method fails.
  [[nodiscard]] Patch evaluate(const joints::PairBodies& bodies,
                               bool has_derivatives) const;

  [[nodiscard]] double modulus() const { return potential_.modulus(); }
  [[nodiscard]] bool is_point() const { return potential_.is_point(); }

 private:
  PairPotential potential_;
  Matrix3 R_A_ = Matrix3::Zero();
  Matrix3 R_B_ = Matrix3::Zero();
  bool has_layers_ = false;
};

}  // namespace limber::contact
