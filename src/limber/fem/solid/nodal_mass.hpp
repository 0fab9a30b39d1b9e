// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "limber/fem/linalg/cholesky.hpp"
#include "limber/fem/solid/material.hpp"
#include "limber/fem/solid/matrices.hpp"

namespace limber::fem {

/// Positive mass of each node, N [kg], which sums to the mesh's mass.
///
/// Equation   m_a = m_e M_aa / sum_b M_bb, element by element
/// Source     [@hinton1976]
/// Limits     Row sums would be negative at corners of second-order
///            tetrahedra. Second order in the element size, not fourth.
[[nodiscard]] VectorX calc_lumped_mass(
    const Mesh& mesh, const std::vector<ElasticMaterial>& materials);

/// Nodal mass matrix, lumped or consistent, with its inverse.
class NodalMass {
 public:
  explicit NodalMass(const VectorX& lumped);
  /// @param M_s N x N consistent scalar mass [kg]
  explicit NodalMass(const SparseMatrix& M_s);

  /// M^-1 f for nodal forces f, 3 x N [N].
  void divide(const Matrix3X& f, Matrix3X& a) const;
  /// M v, 3 x N.
  [[nodiscard]] Matrix3X multiply(const Matrix3X& v) const;

 private:
  VectorX inverse_;  // of a lumped mass
  SparseMatrix M_s_;
  std::optional<SparseCholesky> factor_;  // of a consistent mass
};

}  // namespace limber::fem
