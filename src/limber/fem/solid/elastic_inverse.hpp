// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "limber/common/progress.hpp"
#include "limber/fem/linalg/cholesky.hpp"
#include "limber/fem/solid/matrices.hpp"

namespace limber::fem {

/// The elastic inverse of a body's stiffness: of a clamped body K^-1, of a
/// free one the inertia-relief inverse K^+, which maps a load F to the elastic
/// part of the displacement under F - M q_F, with q_F the rigid acceleration
/// that F causes. It is M-orthogonal to rigid motion.
///
/// Equation   P = I - R R^T M;  x <- x + P (K - s M)^-1 P^T (F - K x)
/// Source     Refinement with a shifted factor, s < 0: the error shrinks by
///            |s| / (lambda_1 + |s|) a step, so that the solution is exact to
///            roundoff although K is singular, and the one factorisation also
///            serves the eigenmodes. Residuals F - K x use the product of
///            `matrices` if there is one (fem/solid/stiffness_product.hpp), so
///            that the solution is accurate even if the factor has only a few
///            digits.
/// Limits     The six rigid motions must be the whole null space of K, which
///            is read as P^T K P: of a K that is rounded they need only nearly
///            be. Bodies up to some 1000 times as long as thick.
class ElasticInverse {
 public:
  /// @param R 3N x 6 M-orthonormal rigid modes; 3N x 0 for a clamped body
  /// @param x node positions [m]; used to estimate the first frequency, which
  ///          sets the shift for any unit of length
  ElasticInverse(const StructuralMatrices& matrices, const MatrixX& R,
                 const Matrix3X& x, const Progress& progress = {});

  /// Of any model with its shift: s < 0 for a free body, 0 for a clamped one.
  /// @param conditioning causes of ill-conditioning, for errors
  ElasticInverse(const StructuralMatrices& matrices, const MatrixX& R,
                 double shift, std::string conditioning);

  /// P (K - s M)^-1 P^T F, for 3N x k loads. [m for N]
  [[nodiscard]] MatrixX solve_shifted(const MatrixX& F) const;

  /// K^+ F. @throws NumericalError if the refinement stalls.
  [[nodiscard]] MatrixX solve(const MatrixX& F) const {
    return solve(F, MatrixX(F.rows(), 0));
  }

  /// K^+ F without its components along `modes`: V' K (the solution) = 0. For
  /// the axial response of a slender body this is accurate where K^+ F is not,
  /// because round-off bends the body.
  ///
  /// Equation   D K^+ F, D = I - V (V' K V)^-1 V' K
  /// @param modes V, 3N x k with K-orthogonal columns, free of rigid motion
  /// @throws NumericalError if the refinement stalls.
  [[nodiscard]] MatrixX solve(const MatrixX& F, const MatrixX& modes) const;

  /// K^+ F, refined from its part in `modes`, which is found exactly: with the
  /// lowest eigenmodes in a few steps.
  ///
  /// Equation   x <- x + V V' r + D P (K - s M)^-1 P^T D' r, r = F - K x
  /// @param modes V, as above
  /// @throws NumericalError if the refinement stalls.
  [[nodiscard]] MatrixX solve_from(const MatrixX& F,
                                   const MatrixX& modes) const;

  /// P X: without rigid motion.
  [[nodiscard]] MatrixX project_motion(const MatrixX& X) const;
  /// P^T F: without net force and moment.
  [[nodiscard]] MatrixX project_load(const MatrixX& F) const;

  [[nodiscard]] const StructuralMatrices& matrices() const {
    return *matrices_;
  }
  [[nodiscard]] const std::vector<int>& dof_order() const { return order_; }
  [[nodiscard]] double shift() const { return shift_; }  ///< s [rad^2/s^2]
  [[nodiscard]] Eigen::Index rigid_count() const { return R_.cols(); }
  [[nodiscard]] double factor_flops() const { return factor_.flops(); }
  /// Causes of the matrix's ill-conditioning, as sentences for an error.
  [[nodiscard]] const std::string& conditioning() const {
    return conditioning_;
  }

 private:
  struct Span {
    MatrixX V;  // V' K V = I
    MatrixX KV;
  };
  [[nodiscard]] Span scale(const MatrixX& modes) const;
  // @param approximate a solution, of a load
  [[nodiscard]] MatrixX refine(
      const MatrixX& load,
      const std::function<MatrixX(const MatrixX&)>& approximate) const;

  const StructuralMatrices* matrices_;
  MatrixX R_;
  MatrixX MR_;
  double shift_ = 0.0;
  std::vector<int> order_;
  std::string conditioning_;
  SparseCholesky factor_;
};

}  // namespace limber::fem
