// SPDX-License-Identifier: BSD-3-Clause
#include "fem/element_matrices.hpp"

#include "fem/mesh_checks.hpp"

namespace limber::fem {

MatrixX calc_element_mass(const ReferenceElement& element, const Matrix3X& x,
                          double density) {
  const Quadrature& rule =
      is_parallel_sided(element, x) ? element.straight : element.curved;
  VectorX measure(rule.weights.size());
  for (Eigen::Index q = 0; q < measure.size(); ++q) {
    const Matrix3 jacobian =
        x * rule.gradients[static_cast<std::size_t>(q)].transpose();
    measure[q] = density * rule.weights[q] * jacobian.determinant();
  }
  return rule.shape * measure.asDiagonal() * rule.shape.transpose();
}

MatrixX calc_element_stiffness(const ReferenceElement& element,
                               const Matrix3X& x,
                               const ElasticMaterial& material) {
  const Quadrature& rule =
      is_parallel_sided(element, x) ? element.stiffness : element.curved;
  const Eigen::Index n = element.node_count;
  MatrixX gradients(3 * n, rule.weights.size());
  VectorX measure(rule.weights.size());
  for (Eigen::Index q = 0; q < measure.size(); ++q) {
    const MatrixX& local = rule.gradients[static_cast<std::size_t>(q)];
    const Matrix3 jacobian = x * local.transpose();  // dx_i / dxi_j
    Eigen::Map<Matrix3X>(gradients.col(q).data(), 3, n) =
        jacobian.inverse().transpose() * local;
    measure[q] = rule.weights[q] * jacobian.determinant();
  }
  const MatrixX S = gradients * measure.asDiagonal() * gradients.transpose();
  const double nu = material.poisson_ratio;
  const double mu = material.youngs_modulus / (2.0 * (1.0 + nu));
  const double lambda = 2.0 * mu * nu / (1.0 - 2.0 * nu);
  MatrixX K(3 * n, 3 * n);
  for (Eigen::Index a = 0; a < n; ++a)
    for (Eigen::Index b = 0; b < n; ++b) {
      const Matrix3 block = S.block<3, 3>(3 * a, 3 * b);
      K.block<3, 3>(3 * a, 3 * b) = lambda * block + mu * block.transpose() +
                                    mu * block.trace() * Matrix3::Identity();
    }
  return K;
}

}  // namespace limber::fem
