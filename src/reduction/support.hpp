// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "fem/matrices.hpp"
#include "fem/mesh.hpp"
#include "flexbody/recipe.hpp"
#include "flexbody/reduced_basis.hpp"

/// Which nodes of a body can move. Part of limber_reduction.
namespace limber::flexbody {

/// Which nodes move, and the body's matrices on them.
struct Support {
  bool is_clamped = false;
  std::vector<int> free_nodes;
  fem::StructuralMatrices matrices;
  MatrixX R;  ///< rigid modes of the free nodes; no columns if clamped
};

/// Nodes of the recipe's clamped groups, sorted. @throws InputError for a group
/// that does not exist.
[[nodiscard]] std::vector<int> find_clamped_nodes(const fem::Mesh& mesh,
                                                  const Recipe& recipe);

/// @throws InputError if the clamp holds every node, or leaves the body a rigid
/// motion.
[[nodiscard]] Support make_support(const fem::Mesh& mesh, const Recipe& recipe,
                                   fem::StructuralMatrices matrices);

/// make_reduced_basis on the support's matrices.
[[nodiscard]] ReducedBasis make_reduced_basis(const MatrixX& vectors,
                                              const Support& support,
                                              double drop_tolerance);

/// The rows (three a node) of `nodes`.
[[nodiscard]] MatrixX take_rows(const MatrixX& full,
                                const std::vector<int>& nodes);

/// The inverse of take_rows: zero elsewhere.
[[nodiscard]] MatrixX put_rows(const MatrixX& part,
                               const std::vector<int>& nodes,
                               Eigen::Index all_nodes);

}  // namespace limber::flexbody
