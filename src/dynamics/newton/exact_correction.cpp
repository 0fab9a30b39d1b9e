// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/newton/exact_correction.hpp"

#include <algorithm>
#include <unsupported/Eigen/IterativeSolvers>

#include "limber/dynamics/newton/force_balance.hpp"
#include "limber/dynamics/newton/matrix_free.hpp"

namespace limber::dynamics {
namespace {

// Relative tolerance of a correction; convergence is quadratic [-].
constexpr double kLinear = 1e-6;
// More would cost more than shortening the step.
constexpr Eigen::Index kKrylovVectors = 60;

}  // namespace

ExactCorrection::ExactCorrection(const SystemModel& model)
    : model_(model), derivative_(model), lengths_(find_length_weights(model)) {
  lengths_ = (lengths_.array() > 0.0).select(lengths_, 1.0);
}

void ExactCorrection::solve(const Point& point, const VectorX& residual,
                            NewtonMatrix& matrix, VectorX& increments) {
  derivative_.set_point(point.state, point.terms, point.acceleration,
                        point.rotation_increments, point.coefficients);
  VectorX rest;
  std::vector<Vector6> laws;
  VectorX solved;
  matrix.solve(model_, point.terms, residual, increments);
  const VectorX right = increments.cwiseProduct(lengths_);
  // Unknowns are lengths, so that norms are means over the system.
  const MatrixFree map(right.size(), [&](const VectorX& x) {
    derivative_.apply_rest(x.cwiseQuotient(lengths_), rest, laws);
    matrix.solve(model_, point.terms, rest, laws, solved);
    return VectorX(x - solved.cwiseProduct(lengths_));
  });
  Eigen::GMRES<MatrixFree, Eigen::IdentityPreconditioner> solver(map);
  solver.set_restart(std::min(kKrylovVectors, right.size()));
  solver.setMaxIterations(std::min(kKrylovVectors, right.size()));
  solver.setTolerance(kLinear);
  const VectorX x = VectorX(solver.solve(right)).cwiseQuotient(lengths_);
  derivative_.apply_rest(x, rest, laws);
  rest += residual;
  for (std::size_t i = 0; i < laws.size(); ++i) {
    laws[i] += NewtonMatrix::find_gap(point.terms, i);
  }
  matrix.solve(model_, point.terms, rest, laws, increments);
}

}  // namespace limber::dynamics
