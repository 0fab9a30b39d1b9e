// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "limber/common/types.hpp"
#include "limber/fem/linalg/sparse_matrix.hpp"

namespace limber::fem {

class StiffnessProduct;

/// A solid's matrices. Degree of freedom 3 n + c is component c of node n.
struct StructuralMatrices {
  SparseMatrix
      M_s;         ///< N x N scalar mass, both triangles; M = M_s (x) I_3 [kg]
  SparseMatrix K;  ///< 3N x 3N stiffness, lower triangle only [N/m]
  /// Products with K without the roundoff of its entries; null if only the
  /// matrix is available.
  std::shared_ptr<const StiffnessProduct> product = nullptr;

  [[nodiscard]] Eigen::Index node_count() const { return M_s.cols(); }
  [[nodiscard]] Eigen::Index dof_count() const { return K.cols(); }
};

/// F - K X and K X, by `product` if there is one, else by the matrix.
[[nodiscard]] MatrixX calc_residual(const StructuralMatrices& matrices,
                                    const MatrixX& F, const MatrixX& X);
[[nodiscard]] MatrixX multiply_stiffness(const StructuralMatrices& matrices,
                                         const MatrixX& X);

/// K - shift (M_s (x) I_3), lower triangle; shift in [rad^2/s^2].
[[nodiscard]] SparseMatrix shift_stiffness(const StructuralMatrices& matrices,
                                           double shift);

/// Matrices of the nodes listed (sorted), all others held fixed.
[[nodiscard]] StructuralMatrices restrict_to(const StructuralMatrices& matrices,
                                             const std::vector<int>& nodes);

/// Mass, centre of mass and second moments of a nodal mass matrix.
struct MassProperties {
  double mass = 0.0;                 ///< [kg]
  Vector3 center = Vector3::Zero();  ///< [m]
  Matrix3 S0 = Matrix3::Zero();      ///< int x x^T dm about `center` [kg m^2]
};
[[nodiscard]] MassProperties calc_mass_properties(const SparseMatrix& M_s,
                                                  const Matrix3X& x);

/// Six rigid motions, M-orthonormal: translations along the axes, rotations
/// about the principal axes of inertia through the centre of mass. 3N x 6.
[[nodiscard]] MatrixX make_rigid_modes(const SparseMatrix& M_s,
                                       const Matrix3X& x);

}  // namespace limber::fem
