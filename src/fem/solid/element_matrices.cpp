// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/solid/element_matrices.hpp"

#include <Eigen/LU>
#include <cmath>
#include <vector>

#include "limber/fem/mesh/mesh_checks.hpp"

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

ElementGradients calc_gradients(const ReferenceElement& element,
                                const Matrix3X& x) {
  const Quadrature& rule =
      is_parallel_sided(element, x) ? element.stiffness : element.curved;
  ElementGradients result{{}, VectorX(rule.weights.size())};
  for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
    const MatrixX& local = rule.gradients[static_cast<std::size_t>(q)];
    const Matrix3 jacobian = x * local.transpose();  // dx_i / dxi_j
    result.at.emplace_back(jacobian.inverse().transpose() * local);
    result.measure[q] = rule.weights[q] * jacobian.determinant();
  }
  return result;
}

namespace {

/// Stress and moduli at a quadrature point.
struct Moduli {
  Matrix3 S, A;
  LameConstants<double> lame;
};

Moduli calc_moduli(Elasticity law, const LameConstants<double>& lame,
                   const Matrix3& H) {
  Tensor<double> gradient;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      gradient[i][j] =
          H(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
  const Stress<double> stress = calc_stress(law, lame, gradient);
  Moduli moduli{Matrix3(), Matrix3::Identity(), lame};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      moduli.S(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          stress.S[i][j];
  if (law == Elasticity::neo_hookean) {
    const Matrix3 F = Matrix3::Identity() + H;
    moduli.A = (F.transpose() * F).inverse();
    moduli.lame.mu -= lame.lambda * std::log(F.determinant());
  }
  return moduli;
}

}  // namespace

MatrixX calc_stiffness(const ElementGradients& gradients,
                       const ElasticMaterial& material) {
  const Eigen::Index n = gradients.at.at(0).cols();
  MatrixX G(3 * n, gradients.measure.size());
  for (Eigen::Index q = 0; q < G.cols(); ++q)
    G.col(q) = gradients.at[static_cast<std::size_t>(q)].reshaped();
  const MatrixX S = G * gradients.measure.asDiagonal() * G.transpose();
  const auto [lambda, mu] = find_lame_constants(material);
  MatrixX K(3 * n, 3 * n);
  for (Eigen::Index a = 0; a < n; ++a)
    for (Eigen::Index b = 0; b < n; ++b) {
      const Matrix3 block = S.block<3, 3>(3 * a, 3 * b);
      K.block<3, 3>(3 * a, 3 * b) = lambda * block + mu * block.transpose() +
                                    mu * block.trace() * Matrix3::Identity();
    }
  return K;
}

MatrixX calc_element_stiffness(const ReferenceElement& element,
                               const Matrix3X& x,
                               const ElasticMaterial& material) {
  return calc_stiffness(calc_gradients(element, x), material);
}

MatrixX calc_element_tangent(const ReferenceElement& element, const Matrix3X& x,
                             const Matrix3X& u, const ElasticMaterial& material,
                             Elasticity law) {
  const ElementGradients gradients = calc_gradients(element, x);
  const LameConstants<double> lame = find_lame_constants(material);
  const Eigen::Index n = element.node_count;
  MatrixX K = MatrixX::Zero(3 * n, 3 * n);
  for (Eigen::Index q = 0; q < gradients.measure.size(); ++q) {
    const Matrix3X& g = gradients.at[static_cast<std::size_t>(q)];
    const Matrix3 H = u * g.transpose();
    const Matrix3 F = Matrix3::Identity() + H;
    const Moduli m = calc_moduli(law, lame, H);
    const Matrix3X p = F * m.A * g;
    const Matrix3 B = F * m.A * F.transpose();
    const MatrixX by_stress = g.transpose() * m.S * g;
    const MatrixX by_moduli = m.lame.mu * (g.transpose() * m.A * g);
    for (Eigen::Index a = 0; a < n; ++a)
      for (Eigen::Index b = 0; b < n; ++b)
        K.block<3, 3>(3 * a, 3 * b) +=
            gradients.measure[q] *
            (by_stress(a, b) * Matrix3::Identity() + by_moduli(a, b) * B +
             m.lame.lambda * p.col(a) * p.col(b).transpose() +
             m.lame.mu * p.col(b) * p.col(a).transpose());
  }
  return K;
}

}  // namespace limber::fem
