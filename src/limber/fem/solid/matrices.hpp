// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "limber/common/types.hpp"
#include "limber/fem/linalg/sparse_matrix.hpp"

namespace limber::fem {

class StiffnessProduct;

/// A body's matrices. Of a solid, degree of freedom 3 n + c is component c of
/// node n, and its mass is scalar. Of any other model, M_s is M itself.
struct StructuralMatrices {
  SparseMatrix M_s;  ///< both triangles: N x N scalar mass, M = M_s (x) I_3
                     ///< [kg]; or M, as large as K
  SparseMatrix K;    ///< stiffness, lower triangle only [N/m]
  /// Products with K without the roundoff of its entries; null if only the
  /// matrix is available.
  std::shared_ptr<const StiffnessProduct> product = nullptr;

  /// Whether M = M_s (x) I_3.
  [[nodiscard]] bool is_scalar_mass() const { return M_s.cols() != K.cols(); }
  /// Of a solid.
  [[nodiscard]] Eigen::Index node_count() const { return M_s.cols(); }
  [[nodiscard]] Eigen::Index dof_count() const { return K.cols(); }
};

/// F - K X and K X, by `product` if there is one, else by the matrix.
[[nodiscard]] MatrixX calc_residual(const StructuralMatrices& matrices,
                                    const MatrixX& F, const MatrixX& X);
[[nodiscard]] MatrixX multiply_stiffness(const StructuralMatrices& matrices,
                                         const MatrixX& X);

/// K - shift M, lower triangle; shift in [rad^2/s^2].
[[nodiscard]] SparseMatrix shift_stiffness(const StructuralMatrices& matrices,
                                           double shift);

/// Matrices of a solid's nodes listed (sorted), all others held fixed.
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
