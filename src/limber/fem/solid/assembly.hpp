// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "limber/common/progress.hpp"
#include "limber/fem/mesh/mesh.hpp"
#include "limber/fem/solid/material.hpp"
#include "limber/fem/solid/matrices.hpp"

namespace limber::fem {

/// Consistent mass and stiffness of the mesh, one material per region, with the
/// mesh's point masses.
/// In parallel; bitwise the same for any number of threads.
/// @throws InputError if the matrix has more entries than an int can count.
[[nodiscard]] StructuralMatrices assemble(
    const Mesh& mesh, const std::vector<ElasticMaterial>& materials,
    const Progress& progress = {});

/// Nodes that share an element with each node, itself included, sorted.
using Neighbours = std::vector<std::vector<int>>;

/// The same without point masses.
[[nodiscard]] StructuralMatrices assemble_elements(
    const Mesh& mesh, const std::vector<ElasticMaterial>& materials,
    const Progress& progress = {});

/// Assembles one stiffness after another with the same pattern, the lower
/// triangle of 3N x 3N. In parallel; the same for any number of threads.
class StiffnessAssembly {
 public:
  /// 3n x 3n stiffness of an element with n nodes [N/m].
  using ElementStiffness =
      std::function<MatrixX(const ElementBlock&, std::size_t element)>;

  explicit StiffnessAssembly(const Mesh& mesh);
  /// The patterns of M_s and K, all zero.
  [[nodiscard]] StructuralMatrices make_zero() const;
  /// @param K with the pattern; its values are overwritten
  void assemble(const ElementStiffness& calc, SparseMatrix& K) const;

 private:
  const Mesh& mesh_;
  Neighbours neighbours_;
};

}  // namespace limber::fem
