// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/newton/exact_correction.hpp"

#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/IterativeSolvers>

#include "limber/common/index.hpp"
#include "limber/dynamics/newton/force_balance.hpp"
#include "limber/dynamics/newton/matrix_free.hpp"
#include "limber/dynamics/system/unknowns.hpp"

namespace limber::dynamics {
namespace {

// Relative tolerance of a correction; convergence is quadratic [-].
constexpr double kLinear = 1e-6;
// More would cost more than shortening the step.
constexpr Eigen::Index kKrylovVectors = 60;

// Calls `visit` with each body's index, and first row and number of its rows.
template <typename Visit>
void for_each_part(const SystemModel& model, Visit visit) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const BodyModel& body = model.bodies[b];
    visit(b, body.row, 6 + body.modes);
    if (body.full < 0) continue;
    const FullModel& full = model.full_bodies[index(body.full)];
    visit(b, first_node_row(model) + full.first, full.dofs());
  }
}

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
  for_each_part(model_, [&](std::size_t b, Eigen::Index row, Eigen::Index n) {
    square_of(b) += increments.segment(row, n)
                        .cwiseProduct(lengths_.segment(row, n))
                        .squaredNorm();
  });
  for_each_part(model_, [&](std::size_t b, Eigen::Index row, Eigen::Index n) {
    if (square_of(b) > 0.0) weights.segment(row, n) /= std::sqrt(square_of(b));
  });
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
