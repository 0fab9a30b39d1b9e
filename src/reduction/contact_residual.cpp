// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/contact_residual.hpp"

#include <algorithm>

#include "limber/flexbody/model/multiply_mass.hpp"

namespace limber::flexbody {
namespace {

/// Loads of patches [begin, end) on the free nodes, 3n x k; clamped nodes pass
/// theirs on to the clamp.
MatrixX list_loads(const std::vector<ContactPatch>& patches, std::size_t begin,
                   std::size_t end, const std::vector<int>& row_of,
                   Eigen::Index rows) {
  MatrixX F = MatrixX::Zero(rows, static_cast<Eigen::Index>(end - begin));
  for (std::size_t p = begin; p < end; ++p) {
    const ContactPatch& patch = patches[p];
    for (std::size_t i = 0; i < patch.nodes.size(); ++i) {
      const int row = row_of[static_cast<std::size_t>(patch.nodes[i])];
      if (row < 0) continue;
      F.col(static_cast<Eigen::Index>(p - begin)).segment<3>(3 * row) +=
          patch.weights[static_cast<Eigen::Index>(i)] * patch.normal;
    }
  }
  return F;
}

VectorX sum_products(const MatrixX& A, const MatrixX& B) {
  return A.cwiseProduct(B).colwise().sum().transpose();
}

}  // namespace

VectorX calc_residual_flexibility(const MeshedBody& body,
                                  const ReducedBasis& basis,
                                  const std::vector<ContactPatch>& patches,
                                  const std::string& what,
                                  const Progress& progress) {
  // More columns are solved at once faster, but need more memory.
  constexpr std::size_t kBlock = 32;
  const fem::StructuralMatrices& matrices = body.support.matrices;
  std::vector<int> row_of(body.mesh.node_count(), -1);
  for (std::size_t i = 0; i < body.support.free_nodes.size(); ++i)
    row_of[static_cast<std::size_t>(body.support.free_nodes[i])] =
        static_cast<int>(i);
  const MatrixX answered =
      fem::multiply_stiffness(matrices, basis.Phi) *
      basis.lambda.cwiseInverse().asDiagonal();  // K Phi Lambda^-1
  VectorX residual(static_cast<Eigen::Index>(patches.size()));
  for (std::size_t begin = 0; begin < patches.size(); begin += kBlock) {
    report(progress, what,
           static_cast<double>(begin) / static_cast<double>(patches.size()));
    const std::size_t end = std::min(begin + kBlock, patches.size());
    MatrixX F = list_loads(patches, begin, end, row_of, matrices.dof_count());
    F -= answered * (basis.Phi.transpose() * F);
    F = body.inverse.project_load(F);
    const MatrixX X = body.inverse.solve_shifted(F);
    residual.segment(static_cast<Eigen::Index>(begin), X.cols()) =
        sum_products(F, X) -
        body.inverse.shift() * sum_products(X, multiply_mass(matrices.M_s, X));
  }
  report(progress, what, 1.0);
  return residual;
}

double calc_hertz_share(const fem::ElasticMaterial& material, double radius) {
  const double nu = material.poisson_ratio;
  return 3.0 * (1.0 - nu * nu) / (5.0 * material.youngs_modulus * radius);
}

}  // namespace limber::flexbody
