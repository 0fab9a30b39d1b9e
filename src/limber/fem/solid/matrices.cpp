// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/solid/matrices.hpp"

#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/common/errors.hpp"
#include "limber/fem/solid/stiffness_product.hpp"

namespace limber::fem {

MatrixX calc_residual(const StructuralMatrices& matrices, const MatrixX& F,
                      const MatrixX& X) {
  if (matrices.product) return matrices.product->subtract_from(F, X);
  return F - multiply_stiffness(matrices.K, X);
}

MatrixX multiply_stiffness(const StructuralMatrices& matrices,
                           const MatrixX& X) {
  return -calc_residual(matrices, MatrixX::Zero(X.rows(), X.cols()), X);
}

SparseMatrix shift_stiffness(const StructuralMatrices& matrices, double shift) {
  SparseMatrix shifted = matrices.K;
  if (shift == 0.0) return shifted;
  if (!matrices.is_scalar_mass()) {
    const SparseMatrix lower = matrices.M_s.triangularView<Eigen::Lower>();
    shifted -= shift * lower;
    return shifted;
  }
  for (Eigen::Index j = 0; j < matrices.node_count(); ++j)
    for (SparseMatrix::InnerIterator it(matrices.M_s, j); it; ++it)
      if (it.row() >= j)
        for (int c = 0; c < 3; ++c)
          shifted.coeffRef(3 * it.row() + c, 3 * j + c) -= shift * it.value();
  return shifted;
}

StructuralMatrices restrict_to(const StructuralMatrices& matrices,
                               const std::vector<int>& nodes) {
  std::vector<int> dofs;
  dofs.reserve(3 * nodes.size());
  for (const int node : nodes)
    for (int c = 0; c < 3; ++c) dofs.push_back(3 * node + c);
  StructuralMatrices part{restrict_matrix(matrices.M_s, nodes),
                          restrict_matrix(matrices.K, dofs)};
  if (matrices.product)
    part.product = std::make_shared<const StiffnessProduct>(
        matrices.product->restrict_to(nodes));
  return part;
}

MassProperties calc_mass_properties(const SparseMatrix& M_s,
                                    const Matrix3X& x) {
  const VectorX nodal = M_s * VectorX::Ones(M_s.cols());
  MassProperties result;
  result.mass = nodal.sum();
  result.center = x * nodal / result.mass;
  const Matrix3X offset = x.colwise() - result.center;
  const Eigen::MatrixX3d weighted = M_s * offset.transpose();
  result.S0 = offset * weighted;
  result.S0 = 0.5 * (result.S0 + result.S0.transpose()).eval();
  return result;
}

MatrixX make_rigid_modes(const SparseMatrix& M_s, const Matrix3X& x) {
  const MassProperties body = calc_mass_properties(M_s, x);
  const Matrix3 inertia = body.S0.trace() * Matrix3::Identity() - body.S0;
  const auto principal = dense::find_eigenpairs(inertia);
  MatrixX R = MatrixX::Zero(3 * x.cols(), 6);
  for (Eigen::Index n = 0; n < x.cols(); ++n) {
    const Vector3 offset = x.col(n) - body.center;
    for (int axis = 0; axis < 3; ++axis) {
      R(3 * n + axis, axis) = 1.0 / std::sqrt(body.mass);
      R.block<3, 1>(3 * n, 3 + axis) =
          Vector3(principal.vectors.col(axis)).cross(offset) /
          std::sqrt(principal.values[axis]);
    }
  }
  return R;
}

}  // namespace limber::fem
