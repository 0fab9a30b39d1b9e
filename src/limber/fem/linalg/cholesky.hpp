// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "limber/fem/linalg/sparse_matrix.hpp"

namespace limber::fem {

/// Fill-reducing order of the rows, of nodes for a solid's M_s: nested
/// dissection of the pattern of the lower triangle.
[[nodiscard]] std::vector<int> order_nodes(const SparseMatrix& M_s);

/// Fill-reducing order of the degrees of freedom: nested dissection of the
/// nodes (pattern of M_s), the three components of a node adjacent.
[[nodiscard]] std::vector<int> order_dofs(const SparseMatrix& M_s);

/// L L^T of a sparse positive definite matrix (CHOLMOD, supernodal).
class SparseCholesky {
 public:
  /// @param lower lower triangle
  /// @param what names the matrix in errors
  /// @param causes sentences on what may make it indefinite, for the error
  /// @throws NumericalError if the matrix is not positive definite or memory
  /// runs out.
  SparseCholesky(const SparseMatrix& lower, const std::vector<int>& order,
                 const std::string& what, const std::string& causes = {});
  ~SparseCholesky();
  SparseCholesky(SparseCholesky&&) noexcept;
  SparseCholesky& operator=(SparseCholesky&&) noexcept;

  /// Factors another matrix of the same pattern, reusing the analysis.
  /// @throws NumericalError as the constructor does.
  void factor(const SparseMatrix& lower);

  [[nodiscard]] MatrixX solve(const MatrixX& right_hand_side) const;
  /// The same in place. Not thread-safe.
  void solve_in_place(Eigen::Ref<MatrixX> x) const;
  [[nodiscard]] double flops() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace limber::fem
