// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "dynamics/residual_derivative.hpp"

namespace limber::dynamics {

/// Newton's correction with the exact derivative of a step's residual, for
/// steps that the factors of NewtonMatrix alone do not bring to an end.
///
/// Equation   (M + E) y = -r, M what NewtonMatrix factors, E what it leaves
///            out: (1 + M^-1 E) x = -M^-1 r by GMRES, in which no stiffness
///            of a coupler appears, and wrenches from the same factors.
/// Limits     allocates.
class ExactCorrection {
 public:
  explicit ExactCorrection(const SystemModel& model);

  /// Where the residual and the factors of `matrix` were made; as
  /// ResidualDerivative::set_point.
  struct Point {
    const SystemState& state;
    const SystemTerms& terms;
    const Rates& acceleration;
    const std::vector<Vector3>& rotation_increments;
    const NewtonMatrix::Coefficients& coefficients;
  };

  /// Increments as NewtonMatrix::solve gives them, and those of wrenches in
  /// `matrix`.
  void solve(const Point& point, const VectorX& residual, NewtonMatrix& matrix,
             VectorX& increments);

 private:
  const SystemModel& model_;
  ResidualDerivative derivative_;
  VectorX lengths_;  // of units of the unknowns
};

}  // namespace limber::dynamics
