// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Sparse>
#include <functional>

#include "limber/common/types.hpp"

namespace limber::flexbody {

/// A basis in canonical form: M-orthonormal, K-diagonal, no rigid motion.
struct ReducedBasis {
  VectorX lambda;  ///< ascending [rad^2/s^2]
  MatrixX Phi;     ///< 3N x m [kg^-1/2]
};

/// M-orthonormal columns that span `vectors` without the rigid modes `R` (3N x
/// 6 or 3N x 0, M-orthonormal). A vector whose remainder has less than
/// `drop_tolerance` [-] of its M-norm is omitted.
/// @param M_s as multiply_mass
/// @throws NumericalError for a vector that is not finite.
[[nodiscard]] MatrixX orthonormalise(const MatrixX& vectors,
                                     const Eigen::SparseMatrix<double>& M_s,
                                     const MatrixX& R, double drop_tolerance);

/// K X for 3N x k columns. [N for m]
using StiffnessFunction = std::function<MatrixX(const MatrixX& X)>;

/// Brings any vectors into canonical form.
///
/// Equation   Phi^T M Phi = I, Phi^T K Phi = diag(lambda), R^T M Phi = 0
/// Source     design.md, section 1
/// @param M_s N x N nodal mass, both triangles [kg]
/// @param drop_tolerance as for orthonormalise() [-]
/// @throws NumericalError for a vector that is not finite or has no stiffness.
[[nodiscard]] ReducedBasis make_reduced_basis(
    const MatrixX& vectors, const Eigen::SparseMatrix<double>& M_s,
    const StiffnessFunction& multiply_stiffness, const MatrixX& R,
    double drop_tolerance);

}  // namespace limber::flexbody
