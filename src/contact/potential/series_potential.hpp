// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/contact/potential/pair_potential.hpp"

namespace limber::contact {

/// Two bodies in series with flexible layers under a flat face of each, along
/// its normal.
///
/// Equation   W_s(x) = min over d of W(x + N d) + d' R^-1 d / 2, N = (n_A,
///            -n_B); gradient that of W there, Hessian K - K N (1 + R N' K
///            N)^-1 R N' K
/// Limits     neglects the turn of N with the bodies
class SeriesPotential {
 public:
  /// @param R_A, R_B of A along its own z axis, and of B >= 0 [m/N]
  /// @throws ContractError as PairPotential.
  SeriesPotential(const PlacedBody& A, const PlacedBody& B, double modulus,
                  double R_A, double R_B);

  /// As PairPotential's. @throws NumericalError if Newton's method fails.
  [[nodiscard]] Patch evaluate(const joints::PairBodies& bodies,
                               bool has_derivatives) const;

  [[nodiscard]] double modulus() const { return potential_.modulus(); }
  [[nodiscard]] bool is_point() const { return potential_.is_point(); }

 private:
  // d' R^-1 d / 2 [J].
  [[nodiscard]] double find_layer_energy(const Eigen::Vector2d& d) const;

  PairPotential potential_;
  Vector3 normal_A_ = Vector3::UnitZ();
  Vector3 normal_B_ = Vector3::UnitZ();
  Eigen::Vector2d R_ = Eigen::Vector2d::Zero();
};

}  // namespace limber::contact
