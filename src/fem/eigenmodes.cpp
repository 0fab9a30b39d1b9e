// SPDX-License-Identifier: BSD-3-Clause
#include "fem/eigenmodes.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "common/errors.hpp"
#include "fem/lanczos.hpp"
#include "fem/pivot_count.hpp"

namespace limber::fem {
namespace {

MatrixX dense_mass(const SparseMatrix& M_s) {
  return multiply_mass(M_s, MatrixX::Identity(3 * M_s.cols(), 3 * M_s.cols()));
}

/// Small models: every eigenpair at once, none can be missed.
Eigenmodes solve_dense(const ElasticInverse& inverse, Eigen::Index count) {
  const StructuralMatrices& full = inverse.matrices();
  const MatrixX lower = MatrixX(full.K);
  const MatrixX K = lower.selfadjointView<Eigen::Lower>();
  const MatrixX M = dense_mass(full.M_s);
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixX> solver(K, M);
  const Eigen::Index rigid = inverse.rigid_count();
  return {solver.eigenvalues().segment(rigid, count),
          solver.eigenvectors().middleCols(rigid, count)};
}

/// Rayleigh-Ritz on K and M themselves: free of the factor's roundoff.
Eigenmodes polish(const ElasticInverse& inverse, const MatrixX& X) {
  const StructuralMatrices& full = inverse.matrices();
  const MatrixX V = inverse.project_motion(X);
  const MatrixX M = V.transpose() * multiply_mass(full.M_s, V);
  const MatrixX K = V.transpose() * multiply_stiffness(full.K, V);
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixX> ritz(
      0.5 * (K + K.transpose()), 0.5 * (M + M.transpose()));
  return {ritz.eigenvalues(), V * ritz.eigenvectors()};
}

/// @throws NumericalError. Roundoff in K phi is eps |K| |phi| whatever lambda
/// is, so the tolerance has a part of that size.
void check_residuals(const ElasticInverse& inverse, const Eigenmodes& modes) {
  constexpr double kTolerance = 1e-7;
  const StructuralMatrices& full = inverse.matrices();
  const MatrixX M_Phi = multiply_mass(full.M_s, modes.Phi);
  const MatrixX residual =
      multiply_stiffness(full.K, modes.Phi) - M_Phi * modes.lambda.asDiagonal();
  const double roundoff = 1e3 * std::numeric_limits<double>::epsilon() *
                          full.K.diagonal().maxCoeff();
  for (Eigen::Index i = 0; i < modes.lambda.size(); ++i) {
    const double allowed = kTolerance * modes.lambda[i] * M_Phi.col(i).norm() +
                           roundoff * modes.Phi.col(i).norm();
    const double found = residual.col(i).norm();
    if (!(found <= allowed))
      throw NumericalError(fmt::format(
          "eigenmode {}: residual {:.3g} N exceeds its tolerance {:.3g} N",
          i + 1, found, allowed));
  }
}

/// Extends until the first `wanted` pairs are converged.
void converge(BlockLanczos& lanczos, Eigen::Index wanted,
              const Progress& progress) {
  // The error of an eigenvalue is this squared, of a vector this itself.
  constexpr double kTolerance = 1e-10;
  for (;;) {
    const bool may_extend = lanczos.extend();
    Eigen::Index converged = 0;
    const Eigen::Index known = std::min(wanted, lanczos.size());
    while (converged < known && lanczos.residuals()[converged] < kTolerance)
      ++converged;
    report(progress, "finding eigenmodes",
           static_cast<double>(converged) / static_cast<double>(wanted));
    if (converged >= wanted || !may_extend) return;
  }
}

/// The widest gap in theta at or after the `count`-th value.
Eigen::Index widest_gap(const VectorX& theta, Eigen::Index count,
                        Eigen::Index converged) {
  Eigen::Index best = count;
  double widest = 0.0;
  for (Eigen::Index i = count; i < converged; ++i) {
    const double gap = theta[i - 1] / theta[i];
    if (gap > widest) {
      widest = gap;
      best = i;
    }
  }
  return best;
}

/// Bound on what roundoff of K moves an eigenvalue by, growth aside: eps
/// times the largest k_ii / m_ii (the scale of the highest eigenvalue).
double eigenvalue_roundoff(const StructuralMatrices& matrices) {
  double largest = 0.0;
  for (Eigen::Index i = 0; i < matrices.dof_count(); ++i)
    largest = std::max(
        largest, matrices.K.coeff(i, i) / matrices.M_s.coeff(i / 3, i / 3));
  return std::numeric_limits<double>::epsilon() * largest;
}

/// How many eigenvalues lie below the cut and were not found; the count is
/// exact, by the signs of the pivots, if their roundoff cannot carry an
/// eigenvalue across the cut.
int count_missing(const ElasticInverse& inverse, const VectorX& theta,
                  Eigen::Index below) {
  constexpr double kSafety = 100.0;
  const double s = inverse.shift();
  const double lower = s + 1.0 / theta[below - 1];
  const double gap = s + 1.0 / theta[below] - lower;
  const double roundoff = kSafety * eigenvalue_roundoff(inverse.matrices());
  for (const double mix : {0.5, 0.4, 0.6, 0.3, 0.7, 0.45, 0.55, 0.35}) {
    const PivotCount count = count_negative_pivots(
        shift_stiffness(inverse.matrices(), lower + mix * gap),
        inverse.dof_order());
    if (count.growth * roundoff < std::min(mix, 1.0 - mix) * gap)
      return count.negative - static_cast<int>(below + inverse.rigid_count());
  }
  throw NumericalError(
      "eigenmodes: the pivots that count them are too small to trust at eight "
      "shifts; ask for one mode more or fewer.");
}

Eigenmodes solve_lanczos(const ElasticInverse& inverse, Eigen::Index count,
                         const Progress& progress) {
  constexpr Eigen::Index kGuard = 4;  // further pairs, to cut in a gap
  constexpr int kMaxTries = 4;
  BlockLanczos lanczos(inverse);
  for (int attempt = 0; attempt < kMaxTries; ++attempt) {
    converge(lanczos, count + kGuard, progress);
    const Eigen::Index below =
        widest_gap(lanczos.theta(), count, count + kGuard);
    report(progress, "counting eigenmodes", 0.0);
    if (count_missing(inverse, lanczos.theta(), below) == 0) {
      Eigenmodes modes = polish(inverse, lanczos.vectors(below));
      return {modes.lambda.head(count), modes.Phi.leftCols(count)};
    }
    lanczos.restart_direction();
  }
  throw NumericalError(fmt::format(
      "eigenmodes: the count of pivots shows that some of the lowest {} are "
      "missing after {} tries",
      count, kMaxTries));
}

}  // namespace

Eigenmodes find_eigenmodes(const ElasticInverse& inverse, int count,
                           const Progress& progress) {
  LIMBER_EXPECT(count >= 0);
  const Eigen::Index dofs = inverse.matrices().dof_count();
  const Eigen::Index elastic = dofs - inverse.rigid_count();
  if (count > elastic)
    throw InputError(fmt::format(
        "{} eigenmodes asked for, but the mesh has {} free degrees of freedom "
        "and so only {} elastic modes. Ask for fewer or refine the mesh.",
        count, dofs, elastic));
  if (count == 0) return {VectorX(0), MatrixX(dofs, 0)};
  // Dense costs dofs^3, Lanczos about dofs count^2.
  const bool is_dense = dofs <= 600 || (dofs <= 2000 && 10 * count > elastic) ||
                        3 * count > elastic;
  Eigenmodes modes = is_dense ? solve_dense(inverse, count)
                              : solve_lanczos(inverse, count, progress);
  check_residuals(inverse, modes);
  return modes;
}

}  // namespace limber::fem
