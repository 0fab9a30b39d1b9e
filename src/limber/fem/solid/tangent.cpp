// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/solid/tangent.hpp"

#include <utility>

#include "limber/fem/solid/element_matrices.hpp"

namespace limber::fem {

TangentFactor::TangentFactor(const Mesh& mesh,
                             const std::vector<ElasticMaterial>& materials,
                             Elasticity law, const SparseMatrix& M_s,
                             std::vector<int> free_nodes)
    : mesh_(mesh),
      materials_(materials),
      law_(law),
      free_(std::move(free_nodes)),
      assembly_(mesh),
      matrices_(assembly_.make_zero()) {
  matrices_.M_s = M_s;
}

void TangentFactor::factor(const Matrix3X& u, double c) {
  assembly_.assemble(
      [&](const ElementBlock& block, std::size_t e) {
        const int* nodes = block.element_nodes(e);
        const std::vector<int> own(nodes, nodes + block.element->node_count);
        return calc_element_tangent(
            *block.element, mesh_.x(Eigen::all, own), u(Eigen::all, own),
            materials_[static_cast<std::size_t>(block.regions[e])], law_);
      },
      matrices_.K);
  const bool is_whole = std::ssize(free_) == matrices_.node_count();
  const StructuralMatrices part =
      is_whole ? StructuralMatrices{} : restrict_to(matrices_, free_);
  const StructuralMatrices& free = is_whole ? matrices_ : part;
  const SparseMatrix shifted = shift_stiffness(free, -c);
  if (factor_) {
    factor_->factor(shifted);
    return;
  }
  const StructuralMatrices pattern = restrict_to(assembly_.make_zero(), free_);
  factor_.emplace(shifted, order_dofs(pattern.M_s), "the tangent stiffness");
}

}  // namespace limber::fem
