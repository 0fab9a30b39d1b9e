// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/modal/support.hpp"

#include <fmt/format.h>

#include <iterator>
#include <set>

#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/common/errors.hpp"

namespace limber::flexbody {
namespace {

/// @throws InputError if the clamped nodes leave a rigid motion.
void check_clamp(const fem::Mesh& mesh, const std::vector<int>& clamped) {
  const Matrix3X x = mesh.x(Eigen::all, clamped);
  const Matrix3X d = x.colwise() - Vector3(x.rowwise().mean());
  const Vector3 moments = dense::find_eigenvalues(Matrix3(d * d.transpose()));
  constexpr double kLine = 1e-12;  // squared, of the body's size
  if (moments[1] > kLine * mesh.size().squaredNorm()) return;
  throw InputError(fmt::format(
      "{}: the clamped groups hold {} nodes on one line, about which the body "
      "can still turn. Clamp a surface, or hold the body by couplers.",
      mesh.source, clamped.size()));
}

}  // namespace

std::vector<int> find_clamped_nodes(const fem::Mesh& mesh,
                                    const Recipe& recipe) {
  std::set<int> clamped;
  for (const std::string& name : recipe.clamped_groups) {
    const fem::PhysicalGroup& group = mesh.groups[fem::find_group(mesh, name)];
    clamped.insert(group.nodes.begin(), group.nodes.end());
  }
  return {clamped.begin(), clamped.end()};
}

Support make_support(const fem::Mesh& mesh, const Recipe& recipe,
                     fem::StructuralMatrices matrices) {
  const std::vector<int> clamped = find_clamped_nodes(mesh, recipe);
  Support support;
  support.is_clamped = !clamped.empty();
  if (support.is_clamped) check_clamp(mesh, clamped);
  support.free_nodes = fem::find_free_nodes(mesh, clamped);
  support.node_count = mesh.x.cols();
  support.translations =
      Matrix3::Identity().replicate(std::ssize(support.free_nodes), 1);
  if (!support.is_clamped) {
    support.R = fem::make_rigid_modes(matrices.M_s, mesh.x);
    support.matrices = std::move(matrices);
    return support;
  }
  if (support.free_nodes.empty())
    throw InputError(fmt::format("{}: every node is clamped; nothing can move.",
                                 mesh.source));
  support.matrices = fem::restrict_to(matrices, support.free_nodes);
  support.R.resize(support.matrices.dof_count(), 0);
  return support;
}

Eigen::Index Support::field_rows() const {
  return lift.rows() > 0 ? lift.rows() : 3 * node_count;
}

MatrixX Support::on_all(const MatrixX& x) const {
  if (lift.rows() > 0) return lift * x;
  return put_rows(x, free_nodes, node_count);
}

MatrixX Support::on_free(const MatrixX& forces) const {
  if (lift.rows() > 0) return lift.transpose() * forces;
  return take_rows(forces, free_nodes);
}

ReducedBasis make_reduced_basis(const MatrixX& vectors, const Support& support,
                                double drop_tolerance) {
  const auto multiply = [&](const MatrixX& X) {
    return fem::multiply_stiffness(support.matrices, X);
  };
  return make_reduced_basis(vectors, support.matrices.M_s, multiply, support.R,
                            drop_tolerance);
}

MatrixX take_rows(const MatrixX& full, const std::vector<int>& nodes) {
  MatrixX part(3 * static_cast<Eigen::Index>(nodes.size()), full.cols());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    part.middleRows<3>(3 * static_cast<Eigen::Index>(i)) =
        full.middleRows<3>(3 * nodes[i]);
  return part;
}

MatrixX put_rows(const MatrixX& part, const std::vector<int>& nodes,
                 Eigen::Index all_nodes) {
  MatrixX full = MatrixX::Zero(3 * all_nodes, part.cols());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    full.middleRows<3>(3 * nodes[i]) =
        part.middleRows<3>(3 * static_cast<Eigen::Index>(i));
  return full;
}

}  // namespace limber::flexbody
