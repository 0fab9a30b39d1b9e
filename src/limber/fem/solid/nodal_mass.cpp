// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/solid/nodal_mass.hpp"

#include "limber/common/errors.hpp"
#include "limber/fem/mesh/mesh_checks.hpp"
#include "limber/fem/solid/element_matrices.hpp"

namespace limber::fem {

VectorX calc_lumped_mass(const Mesh& mesh,
                         const std::vector<ElasticMaterial>& materials) {
  LIMBER_EXPECT(materials.size() == mesh.volume_groups.size());
  VectorX mass = VectorX::Zero(mesh.x.cols());
  for (const ElementBlock& block : mesh.blocks) {
    for (std::size_t e = 0; e < block.size(); ++e) {
      const ElasticMaterial& material =
          materials[static_cast<std::size_t>(block.regions[e])];
      const MatrixX M = calc_element_mass(
          *block.element, element_positions(mesh, block, e), material.density);
      const VectorX fraction = M.diagonal() * (M.sum() / M.trace());
      for (Eigen::Index a = 0; a < fraction.size(); ++a) {
        mass[block.element_nodes(e)[a]] += fraction[a];
      }
    }
  }
  for (const auto& [node, point] : mesh.masses) mass[node] += point;
  return mass;
}

NodalMass::NodalMass(const VectorX& lumped)
    : inverse_(lumped.cwiseInverse()), M_s_(lumped.size(), lumped.size()) {
  LIMBER_EXPECT(lumped.minCoeff() > 0.0);
  M_s_.setIdentity();
  M_s_.diagonal() = lumped;
}

NodalMass::NodalMass(const SparseMatrix& M_s)
    : M_s_(M_s),
      factor_(std::in_place, M_s.triangularView<Eigen::Lower>(),
              order_nodes(M_s), "mass matrix") {}

void NodalMass::divide(const Matrix3X& f, Matrix3X& a) const {
  if (factor_) {
    a = factor_->solve(f.transpose()).transpose();
  } else {
    a.noalias() = f * inverse_.asDiagonal();
  }
}

Matrix3X NodalMass::multiply(const Matrix3X& v) const { return v * M_s_; }

}  // namespace limber::fem
