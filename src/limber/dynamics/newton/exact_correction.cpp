// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/newton/exact_correction.hpp"

#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/IterativeSolvers>

#include "limber/common/index.hpp"
#include "limber/dynamics/bodies/body.hpp"
#include "limber/dynamics/newton/force_balance.hpp"
#include "limber/dynamics/newton/matrix_free.hpp"
#include "limber/dynamics/system/unknowns.hpp"

namespace limber::dynamics {
namespace {

// Relative tolerance of a correction; convergence is quadratic [-].
constexpr double kLinear = 1e-6;
// More would cost more than shortening the step.
constexpr Eigen::Index kKrylovVectors = 60;

}  // namespace

ExactCorrection::ExactCorrection(const SystemModel& model)
    : model_(model),
      groups_(model),
      derivative_(model),
      lengths_(find_length_weights(model)) {
  lengths_ = (lengths_.array() > 0.0).select(lengths_, 1.0);
}

VectorX ExactCorrection::find_weights(const SystemTerms& terms,
                                      const VectorX& increments) {
  groups_.join_touching(model_, terms);
  VectorX squares = VectorX::Zero(std::ssize(model_.bodies));
  const auto square_of = [&](std::size_t b) -> double& {
    return squares[static_cast<Eigen::Index>(groups_.find_joined(b))];
  };
  VectorX weights = lengths_;
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    for (const UnknownRange& range : list_unknowns(model_, b)) {
      square_of(b) += increments.segment(range.row, range.size)
                          .cwiseProduct(lengths_.segment(range.row, range.size))
                          .squaredNorm();
    }
  }
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    if (!(square_of(b) > 0.0)) continue;
    for (const UnknownRange& range : list_unknowns(model_, b)) {
      weights.segment(range.row, range.size) /= std::sqrt(square_of(b));
    }
  }
  return weights;
}

void ExactCorrection::solve(const Point& point, const VectorX& residual,
                            NewtonMatrix& matrix, VectorX& increments) {
  derivative_.set_point(point.state, point.terms, point.acceleration,
                        point.motion, point.coefficients);
  VectorX rest;
  std::vector<Vector6> laws;
  VectorX solved;
  matrix.solve(model_, point.terms, residual, increments);
  const VectorX weights = find_weights(point.terms, increments);
  const VectorX right = increments.cwiseProduct(weights);
  const MatrixFree map(right.size(), [&](const VectorX& x) {
    derivative_.apply_rest(x.cwiseQuotient(weights), rest, laws);
    matrix.solve(model_, point.terms, rest, laws, solved);
    return VectorX(x - solved.cwiseProduct(weights));
  });
  Eigen::GMRES<MatrixFree, Eigen::IdentityPreconditioner> solver(map);
  solver.set_restart(std::min(kKrylovVectors, right.size()));
  solver.setMaxIterations(std::min(kKrylovVectors, right.size()));
  solver.setTolerance(kLinear);
  const VectorX x = VectorX(solver.solve(right)).cwiseQuotient(weights);
  derivative_.apply_rest(x, rest, laws);
  rest += residual;
  for (std::size_t i = 0; i < laws.size(); ++i) {
    laws[i] += NewtonMatrix::find_gap(point.terms, i);
  }
  matrix.solve(model_, point.terms, rest, laws, increments);
}

}  // namespace limber::dynamics
