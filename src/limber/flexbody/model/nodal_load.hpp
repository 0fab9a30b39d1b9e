// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/flexbody/model/reduced_body.hpp"

namespace limber::flexbody {

/// Nodal forces that change in time, reduced once so that a step needs no
/// nodes. Expressed in the body frame B; column i applies on [times[i],
/// times[i+1]), zero before, the last column from its time on.
///
/// Equation   F = sum_n f_n, M = sum_n (x_n + Phi_n eta) x f_n, Q = Phi^T f;
///            at level nonlinear m counts the products of paired modes, too,
///            and Phi their columns (mode_products.hpp)
struct NodalLoad {
  std::vector<double> times;  ///< T, increasing [s]
  Matrix3X force;             ///< 3 x T [N]
  Matrix3X moment;            ///< 3 x T about the c.m., undeformed [N m]
  /// 3 x m T: column i m + k is dM / d eta_k [kg^-1/2 N].
  Matrix3X moment_by_mode;
  MatrixX modal;  ///< m x T [kg^-1/2 N]
};

/// @param forces 3n x T at the body's n rows [N]
/// @throws InputError if times do not increase or a value is not finite.
[[nodiscard]] NodalLoad reduce_nodal_load(const ReducedBody& body,
                                          const std::vector<double>& times,
                                          const MatrixX& forces);
/// The same for level nonlinear.
/// @throws ContractError for a body without a manifold.
[[nodiscard]] NodalLoad reduce_second_order_load(
    const ReducedBody& body, const std::vector<double>& times,
    const MatrixX& forces);

}  // namespace limber::flexbody
