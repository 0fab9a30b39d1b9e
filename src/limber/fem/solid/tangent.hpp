// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "limber/fem/linalg/cholesky.hpp"
#include "limber/fem/solid/assembly.hpp"
#include "limber/fem/solid/hyperelastic.hpp"

namespace limber::fem {

/// Factors of the tangent of a solid's equations of motion, c M + K(u), on the
/// free nodes. The symbolic analysis is done once.
class TangentFactor {
 public:
  /// @param mesh, materials stored by reference
  /// @param M_s N x N scalar mass [kg], stored by reference
  TangentFactor(const Mesh& mesh, const std::vector<ElasticMaterial>& materials,
                Elasticity law, const SparseMatrix& M_s,
                std::vector<int> free_nodes);

  /// @param u 3 x N displacements [m] @param c [1/s^2]
  /// @throws NumericalError if the matrix is not positive definite.
  void factor(const Matrix3X& u, double c);
  /// @param right_hand_side rows of the free nodes [N]
  [[nodiscard]] MatrixX solve(const MatrixX& right_hand_side) const {
    return factor_->solve(right_hand_side);
  }
  void solve_in_place(Eigen::Ref<MatrixX> x) const {
    factor_->solve_in_place(x);
  }
  [[nodiscard]] const std::vector<int>& free_nodes() const { return free_; }

 private:
  const Mesh& mesh_;
  const std::vector<ElasticMaterial>& materials_;
  Elasticity law_;
  std::vector<int> free_;
  StiffnessAssembly assembly_;
  StructuralMatrices matrices_;  // K is the tangent
  std::optional<SparseCholesky> factor_;
};

}  // namespace limber::fem
