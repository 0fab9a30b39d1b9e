// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/fem/mesh/mesh.hpp"
#include "limber/fem/solid/matrices.hpp"
#include "limber/flexbody/modal/reduced_basis.hpp"
#include "limber/flexbody/model/recipe.hpp"

/// Free and clamped nodes of a body. Part of limber_reduction.
namespace limber::flexbody {

/// The free degrees of freedom and the body's matrices on them.
struct Support {
  bool is_clamped = false;
  std::vector<int> free_nodes;  ///< indices; of a mesh
  Eigen::Index node_count = 0;  ///< of all nodes of a mesh
  /// Fields of all nodes from the free degrees of freedom; no rows for a mesh.
  fem::SparseMatrix lift;
  fem::StructuralMatrices matrices;
  /// Rigid modes of the free degrees of freedom [kg^-1/2]; no columns if
  /// clamped.
  MatrixX R;
  /// Unit translations along x, y, z of the free degrees of freedom.
  MatrixX translations;

  [[nodiscard]] Eigen::Index field_rows() const;
  /// Fields of all nodes; zero at clamped ones.
  [[nodiscard]] MatrixX on_all(const MatrixX& x) const;
  /// Its transpose: generalized forces of nodal forces.
  [[nodiscard]] MatrixX on_free(const MatrixX& forces) const;
};

/// Nodes of the recipe's clamped groups, sorted. @throws InputError for a group
/// that does not exist.
[[nodiscard]] std::vector<int> find_clamped_nodes(const fem::Mesh& mesh,
                                                  const Recipe& recipe);

/// @throws InputError if every node is clamped, or the clamp leaves a rigid
/// motion.
[[nodiscard]] Support make_support(const fem::Mesh& mesh, const Recipe& recipe,
                                   fem::StructuralMatrices matrices);

/// make_reduced_basis on the support's matrices.
/// @param drop_tolerance as for orthonormalise() [-]
[[nodiscard]] ReducedBasis make_reduced_basis(const MatrixX& vectors,
                                              const Support& support,
                                              double drop_tolerance);

/// The rows (three per node) of `nodes`.
[[nodiscard]] MatrixX take_rows(const MatrixX& full,
                                const std::vector<int>& nodes);

/// The inverse of take_rows: zero elsewhere.
[[nodiscard]] MatrixX put_rows(const MatrixX& part,
                               const std::vector<int>& nodes,
                               Eigen::Index all_nodes);

}  // namespace limber::flexbody
