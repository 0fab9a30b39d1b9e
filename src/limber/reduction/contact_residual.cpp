// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/contact_residual.hpp"

#include <algorithm>

#include "limber/flexbody/model/multiply_mass.hpp"

namespace limber::flexbody {
namespace {

/// The part of loads on patches outside of a basis and rigid motion.
class Leftover {
 public:
  Leftover(const BodyWithSurface& surface_body, const ReducedBasis& basis)
      : surface_body_(surface_body),
        basis_(basis),
        answered_(fem::multiply_stiffness(surface_body.body.support.matrices,
                                          basis.Phi) *
                  basis.lambda.cwiseInverse().asDiagonal()) {}

  /// F of patches [begin, end) on the free degrees of freedom; forces on
  /// clamped nodes act on the clamp.
  [[nodiscard]] MatrixX list_loads(const std::vector<ContactPatch>& patches,
                                   std::size_t begin, std::size_t end) const {
    MatrixX loads = MatrixX::Zero(
        3 * static_cast<Eigen::Index>(surface_body_.mesh.node_count()),
        static_cast<Eigen::Index>(end - begin));
    for (std::size_t p = begin; p < end; ++p) {
      const ContactPatch& patch = patches[p];
      for (std::size_t i = 0; i < patch.nodes.size(); ++i)
        loads.col(static_cast<Eigen::Index>(p - begin))
            .segment<3>(3 * static_cast<Eigen::Index>(patch.nodes[i])) +=
            patch.weights[static_cast<Eigen::Index>(i)] * patch.normal;
    }
    return list_loads(loads);
  }

  /// The same of loads on all nodes, 3N x k.
  [[nodiscard]] MatrixX list_loads(const MatrixX& loads) const {
    const MatrixX F = surface_body_.put_on_free(loads);
    return surface_body_.body.inverse.project_load(
        F - answered_ * (basis_.Phi.transpose() * F));
  }

 private:
  const BodyWithSurface& surface_body_;
  const ReducedBasis& basis_;
  MatrixX answered_;  // K Phi Lambda^-1
};

VectorX sum_products(const MatrixX& A, const MatrixX& B) {
  return A.cwiseProduct(B).colwise().sum().transpose();
}

// F^T K^+ F
MatrixX multiply_flexibility(const ElasticBody& body, const MatrixX& F) {
  const MatrixX X = body.inverse.solve_shifted(F);
  const MatrixX R =
      F.transpose() * X -
      body.inverse.shift() *
          (X.transpose() * multiply_mass(body.support.matrices.M_s, X));
  return 0.5 * (R + R.transpose());
}

}  // namespace

VectorX calc_residual_flexibility(const BodyWithSurface& surface_body,
                                  const ReducedBasis& basis,
                                  const std::vector<ContactPatch>& patches,
                                  const std::string& what,
                                  const Progress& progress) {
  // More columns are solved at once faster, but need more memory.
  constexpr std::size_t kBlock = 32;
  const ElasticBody& body = surface_body.body;
  const Leftover leftover(surface_body, basis);
  VectorX residual(static_cast<Eigen::Index>(patches.size()));
  for (std::size_t begin = 0; begin < patches.size(); begin += kBlock) {
    report(progress, what,
           static_cast<double>(begin) / static_cast<double>(patches.size()));
    const std::size_t end = std::min(begin + kBlock, patches.size());
    const MatrixX F = leftover.list_loads(patches, begin, end);
    const MatrixX X = body.inverse.solve_shifted(F);
    residual.segment(static_cast<Eigen::Index>(begin), X.cols()) =
        sum_products(F, X) -
        body.inverse.shift() *
            sum_products(X, multiply_mass(body.support.matrices.M_s, X));
  }
  report(progress, what, 1.0);
  return residual;
}

MatrixX calc_residual_matrix(const BodyWithSurface& surface_body,
                             const ReducedBasis& basis, const MatrixX& loads) {
  return multiply_flexibility(surface_body.body,
                              Leftover(surface_body, basis).list_loads(loads));
}

double calc_hertz_fraction(const fem::ElasticMaterial& material,
                           double radius) {
  const double nu = material.poisson_ratio;
  return 3.0 * (1.0 - nu * nu) / (5.0 * material.youngs_modulus * radius);
}

}  // namespace limber::flexbody
