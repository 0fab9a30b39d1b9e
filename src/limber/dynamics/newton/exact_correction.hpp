// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/dynamics/newton/motion_groups.hpp"
#include "limber/dynamics/newton/residual_derivative.hpp"

namespace limber::dynamics {

/// Newton's correction with the exact derivative of a step's residual, for
/// steps that do not converge with the factors of NewtonMatrix alone.
///
/// Equation   (M + E) y = -r, M the matrix of NewtonMatrix, E the part that it
///            neglects: (1 + M^-1 E) x = -M^-1 r by GMRES, which contains no
///            stiffness of couplers, and wrenches from the same factors.
/// Limits     allocates.
class ExactCorrection {
 public:
  explicit ExactCorrection(const SystemModel& model);

  /// Point of the residual and of the factors of `matrix`; as
  /// ResidualDerivative::set_point.
  struct Point {
    const SystemState& state;
    const SystemTerms& terms;
    const VectorX& acceleration;
    const VectorX& motion;
    const NewtonMatrix::Coefficients& coefficients;
  };

  /// Increments as for NewtonMatrix::solve, and those of wrenches in `matrix`.
  void solve(const Point& point, const VectorX& residual, NewtonMatrix& matrix,
             VectorX& increments);

 private:
  // Weights of the unknowns: lengths, in each group relative to the increments
  // given, so that GMRES has the same relative error in all of them.
  VectorX find_weights(const SystemTerms& terms, const VectorX& increments);

  const SystemModel& model_;
  MotionGroups groups_;
  ResidualDerivative derivative_;
  VectorX lengths_;  // of units of the unknowns
};

}  // namespace limber::dynamics
