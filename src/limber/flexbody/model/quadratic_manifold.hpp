// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/common/types.hpp"

namespace limber::flexbody {

/// Number of pairs i <= j of n modes, stored in the order 11, 12, .., 1n, 22,
/// ..
[[nodiscard]] constexpr Eigen::Index count_pairs(Eigen::Index n) {
  return n * (n + 1) / 2;
}

/// Second-order kinematics of a reduced body, for level `nonlinear`. Interfaces
/// have their part of it in InterfaceTable.
///
/// Equation   u = Phi q + sum_{i <= j} c_ij theta_ij q_i q_j, c_ii = 1/2, else
///            1, for i, j in P: the modes that rotate more than they strain
/// Source     modal derivatives [@idelsohn1985]; docs/theory/nonlinear.md
struct QuadraticManifold {
  std::vector<int> paired;  ///< P, increasing
  /// |P| x pairs: quadratic part of the modal strains, row r
  /// (flexbody/elasticity/quadratic_strain.hpp) [kg^-1/2 m^-1 rad/s].
  MatrixX Q;
  /// s x pairs: self-strains, in-plane stretch of plates and closed frames that
  /// bend, which no displacement takes away [the same]. None of slender bars.
  MatrixX self;
  /// 6 x pairs: sym(int x theta_ij' dm), components (xx, yy, zz, xy, xz, yz),
  /// which the shape integral S2 lacks [-].
  Matrix6X S2;
  MatrixX Theta_B;  ///< 3n x pairs: theta at the body's rows [kg^-1 m^-1]
};

}  // namespace limber::flexbody
