// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/solid/element_matrices.hpp"

#include <Eigen/LU>
#include <cmath>
#include <vector>

#include "limber/fem/mesh/mesh_checks.hpp"
#include "limber/fem/solid/hooke.hpp"

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
  ElementGradients result{{}, VectorX(rule.weights.size()), x * rule.shape};
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

Moduli calc_moduli(Elasticity law, const Hooke& hooke, const Matrix3& H) {
  const LameConstants<double>& lame = hooke.lame;
  Moduli moduli{hooke.calc_stress(law, H), Matrix3::Identity(), lame};
  if (law == Elasticity::neo_hookean) {
    const Matrix3 F = Matrix3::Identity() + H;
    moduli.A = (F.transpose() * F).inverse();
    moduli.lame.mu -= lame.lambda * std::log(F.determinant());
  }
  return moduli;
}

MatrixX calc_anisotropic_stiffness(const ElementGradients& gradients,
                                   const ElasticMaterial& material) {
  const Eigen::Index points = gradients.measure.size();
  const Eigen::Index size = 3 * gradients.at.at(0).cols();
  const std::vector<Hooke> laws = list_laws(material, gradients.x);
  MatrixX B(6 * points, size);
  MatrixX CB(6 * points, size);
  for (Eigen::Index q = 0; q < points; ++q) {
    const auto at = static_cast<std::size_t>(q);
    B.middleRows<6>(6 * q) =
        make_strain_rows(Matrix3::Identity(), gradients.at[at]);
    CB.middleRows<6>(6 * q) =
        gradients.measure[q] * (*laws[at].C * B.middleRows<6>(6 * q));
  }
  const MatrixX K = B.transpose() * CB;
  return 0.5 * (K + K.transpose());
}

MatrixX calc_anisotropic_tangent(const ElementGradients& gradients,
                                 const Matrix3X& u,
                                 const ElasticMaterial& material) {
  const Eigen::Index n = u.cols();
  const std::vector<Hooke> laws = list_laws(material, gradients.x);
  MatrixX K = MatrixX::Zero(3 * n, 3 * n);
  for (std::size_t q = 0; q < laws.size(); ++q) {
    const double measure = gradients.measure[static_cast<Eigen::Index>(q)];
    const Matrix3X& g = gradients.at[q];
    const Matrix3 H = u * g.transpose();
    const MatrixX B = make_strain_rows(Matrix3::Identity() + H, g);
    K += measure * (B.transpose() * (*laws[q].C * B));
    const Matrix3 S = laws[q].calc_stress(Elasticity::st_venant_kirchhoff, H);
    const MatrixX by_stress = measure * (g.transpose() * S * g);
    for (Eigen::Index a = 0; a < n; ++a)
      for (Eigen::Index b = 0; b < n; ++b)
        K.block<3, 3>(3 * a, 3 * b).diagonal().array() += by_stress(a, b);
  }
  return K;
}

}  // namespace

MatrixX calc_stiffness(const ElementGradients& gradients,
                       const ElasticMaterial& material) {
  if (material.anisotropy)
    return calc_anisotropic_stiffness(gradients, material);
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
  if (material.anisotropy)
    return calc_anisotropic_tangent(gradients, u, material);
  const Hooke hooke(material, Vector3::Zero());
  const Eigen::Index n = element.node_count;
  MatrixX K = MatrixX::Zero(3 * n, 3 * n);
  for (Eigen::Index q = 0; q < gradients.measure.size(); ++q) {
    const Matrix3X& g = gradients.at[static_cast<std::size_t>(q)];
    const Matrix3 H = u * g.transpose();
    const Matrix3 F = Matrix3::Identity() + H;
    const Moduli m = calc_moduli(law, hooke, H);
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
