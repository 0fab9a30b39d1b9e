// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/solid/elastic_inverse.hpp"

#include <fmt/format.h>

#include <limits>
#include <vector>

#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/common/duration.hpp"
#include "limber/common/errors.hpp"
#include "limber/fem/linalg/factor_cost.hpp"
#include "limber/fem/solid/conditioning.hpp"

namespace limber::fem {
namespace {

/// All displacement fields quadratic in position: 27 columns. They include the
/// bending, torsion and stretching of a simple body.
MatrixX quadratic_fields(const Matrix3X& x) {
  const Matrix3X scaled = scale_positions(x);
  MatrixX fields = MatrixX::Zero(3 * x.cols(), 27);
  for (Eigen::Index n = 0; n < x.cols(); ++n) {
    const Vector3 d = scaled.col(n);
    const Eigen::Matrix<double, 9, 1> monomials{
        d[0],        d[1],        d[2],        d[0] * d[0], d[1] * d[1],
        d[2] * d[2], d[0] * d[1], d[1] * d[2], d[2] * d[0]};
    for (int k = 0; k < 9; ++k)
      for (int c = 0; c < 3; ++c) fields(3 * n + c, 3 * k + c) = monomials[k];
  }
  return fields;
}

/// Rayleigh-Ritz on the quadratic fields: an upper bound of the first elastic
/// eigenvalue, of its order of magnitude in any units [rad^2/s^2].
double estimate_first_eigenvalue(const StructuralMatrices& matrices,
                                 const MatrixX& R, const MatrixX& MR,
                                 const Matrix3X& x) {
  MatrixX V = quadratic_fields(x);
  V -= R * (MR.transpose() * V);
  const MatrixX M = V.transpose() * multiply_mass(matrices.M_s, V);
  const MatrixX K = V.transpose() * multiply_stiffness(matrices.K, V);
  const auto mass = dense::find_eigenpairs(M);
  // Linear fields include rotations, which the projection removes, so M is
  // singular here: keep the independent part.
  constexpr double kIndependent = 1e-6;
  const double largest = mass.values[M.cols() - 1];
  Eigen::Index dependent = 0;
  while (mass.values[dependent] < kIndependent * largest) ++dependent;
  const Eigen::Index kept = M.cols() - dependent;
  const MatrixX T =
      mass.vectors.rightCols(kept) *
      mass.values.tail(kept).cwiseSqrt().cwiseInverse().asDiagonal();
  const MatrixX reduced = T.transpose() * K * T;
  return dense::find_eigenvalues(reduced)[0];
}

/// A small part of the first eigenvalue: refinement gains about two digits a
/// step, and the rigid motions are amplified by no more than two.
double choose_shift(const StructuralMatrices& matrices, const MatrixX& R,
                    const MatrixX& MR, const Matrix3X& x) {
  if (R.cols() == 0) return 0.0;
  constexpr double kFraction = 0.01;
  return -kFraction * estimate_first_eigenvalue(matrices, R, MR, x);
}

/// X - U W' X, with W' U = I: what W measures of it vanishes.
MatrixX remove_span(const MatrixX& X, const MatrixX& U, const MatrixX& W) {
  if (U.cols() == 0) return X;
  return X - U * (W.transpose() * X);
}

constexpr double kLong = 20.0;  // s; eigenmodes take about as long again

// @param order of degrees of freedom, those of a node adjacent
void report_factors(const SparseMatrix& M_s, const std::vector<int>& order,
                    const Progress& progress) {
  if (!progress) return;
  std::vector<int> nodes;
  for (std::size_t i = 0; i < order.size(); i += 3) {
    nodes.push_back(order[i] / 3);
  }
  report(
      progress,
      with_duration("factorising", estimate_factor_seconds(M_s, nodes), kLong),
      0.0);
}

}  // namespace

ElasticInverse::ElasticInverse(const StructuralMatrices& matrices,
                               const MatrixX& R, const Matrix3X& x,
                               const Progress& progress)
    : matrices_(&matrices),
      R_(R),
      MR_(multiply_mass(matrices.M_s, R)),
      shift_(choose_shift(matrices, R_, MR_, x)),
      order_(order_dofs(matrices.M_s)),
      conditioning_(fem::describe_conditioning(matrices, x)),
      factor_((report_factors(matrices.M_s, order_, progress),
               SparseCholesky(shift_stiffness(matrices, shift_), order_,
                              "stiffness matrix", conditioning_))) {
  report(progress, "factorising", 1.0);
}

ElasticInverse::ElasticInverse(const StructuralMatrices& matrices,
                               const MatrixX& R, double shift,
                               std::string conditioning)
    : matrices_(&matrices),
      R_(R),
      MR_(multiply_mass(matrices.M_s, R)),
      shift_(shift),
      order_(order_nodes(shift_stiffness(matrices, shift))),
      conditioning_(std::move(conditioning)),
      factor_(shift_stiffness(matrices, shift), order_, "stiffness matrix",
              conditioning_) {}

MatrixX ElasticInverse::project_motion(const MatrixX& X) const {
  return remove_span(X, R_, MR_);
}

MatrixX ElasticInverse::project_load(const MatrixX& F) const {
  return remove_span(F, MR_, R_);
}

MatrixX ElasticInverse::solve_shifted(const MatrixX& F) const {
  return project_motion(factor_.solve(project_load(F)));
}

ElasticInverse::Span ElasticInverse::scale(const MatrixX& modes) const {
  if (modes.cols() == 0) {
    const MatrixX none(matrices_->dof_count(), 0);
    return {none, none};
  }
  const MatrixX K_modes = multiply_stiffness(*matrices_, modes);
  const VectorX factors = modes.cwiseProduct(K_modes)
                              .colwise()
                              .sum()
                              .transpose()
                              .cwiseSqrt()
                              .cwiseInverse();
  return {modes * factors.asDiagonal(), K_modes * factors.asDiagonal()};
}

MatrixX ElasticInverse::solve(const MatrixX& F, const MatrixX& modes) const {
  const Span span = scale(modes);
  // D and D', with which the solution and what is left of the load vanish on
  // the modes together, whatever the shift.
  return refine(remove_span(project_load(F), span.KV, span.V),
                [&](const MatrixX& load) {
                  return remove_span(solve_shifted(load), span.V, span.KV);
                });
}

MatrixX ElasticInverse::solve_from(const MatrixX& F,
                                   const MatrixX& modes) const {
  const Span span = scale(modes);
  return refine(project_load(F), [&](const MatrixX& load) {
    const MatrixX rest = remove_span(load, span.KV, span.V);
    return MatrixX(span.V * (span.V.transpose() * load) +
                   remove_span(solve_shifted(rest), span.V, span.KV));
  });
}

MatrixX ElasticInverse::refine(
    const MatrixX& load,
    const std::function<MatrixX(const MatrixX&)>& approximate) const {
  constexpr int kMaxSteps = 60;
  constexpr double kTolerance = 1e-13;  // correction, relative to the solution
  constexpr double kStalled = 1e-9;     // roundoff allowed for a hard matrix
  constexpr double kCoarse = 1e-9;      // accuracy that the matrix suffices for
  if (load.cols() == 0) return load;
  MatrixX X = approximate(load);
  double previous = std::numeric_limits<double>::infinity();
  bool is_fine = false;  // residual by the product, which costs more
  for (int step = 0; step < kMaxSteps; ++step) {
    const MatrixX correction =
        approximate(is_fine ? calc_residual(*matrices_, load, X)
                            : load - multiply_stiffness(matrices_->K, X));
    X += correction;
    const double change =
        (correction.colwise().norm().array() /
         X.colwise().norm().array().max(std::numeric_limits<double>::min()))
            .maxCoeff();
    const bool has_stalled = change > 0.5 * previous;
    if (is_fine &&
        (change <= kTolerance || (has_stalled && change <= kStalled)))
      return X;
    previous = change;
    if (is_fine || (change > kCoarse && !has_stalled)) continue;
    is_fine = true;
    previous = std::numeric_limits<double>::infinity();
  }
  // The softest of the solutions.
  const VectorX stiffness =
      X.cwiseProduct(load).colwise().sum().transpose().cwiseQuotient(
          X.colwise().squaredNorm().transpose());
  throw NumericalError(fmt::format(
      "static solution: after {} refinements the correction is {:.3g} of the "
      "solution (tolerance {:.0g}). The stiffness matrix is too "
      "ill-conditioned: a single node is up to {:.1g} times as stiff as the "
      "body, and double precision resolves 1e16.{}",
      kMaxSteps, previous, kStalled,
      matrices_->K.diagonal().maxCoeff() / stiffness.minCoeff(),
      conditioning_));
}

}  // namespace limber::fem
