// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/solid/eigenmodes.hpp"

#include <Spectra/SymGEigsShiftSolver.h>
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <random>

#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/common/errors.hpp"

namespace limber::fem {
namespace {

MatrixX dense_mass(const StructuralMatrices& matrices) {
  const Eigen::Index dofs = matrices.dof_count();
  return multiply_mass(matrices.M_s, MatrixX::Identity(dofs, dofs));
}

/// Elastic modes at most: a row without mass has none.
Eigen::Index count_elastic(const ElasticInverse& inverse) {
  const StructuralMatrices& full = inverse.matrices();
  Eigen::Index moving = full.dof_count();
  if (!full.is_scalar_mass())
    moving -= (VectorX(full.M_s.diagonal()).array() == 0.0).count();
  return moving - inverse.rigid_count();
}

[[noreturn]] void refuse_count(Eigen::Index count, Eigen::Index dofs,
                               Eigen::Index elastic) {
  throw InputError(fmt::format(
      "{} eigenmodes requested, but the mesh has {} free degrees of freedom "
      "and so only {} elastic modes. Request fewer or refine the mesh.",
      count, dofs, elastic));
}

/// Rayleigh-Ritz on K and M themselves: free of the factor's roundoff.
Eigenmodes polish(const ElasticInverse& inverse, const MatrixX& X) {
  const StructuralMatrices& full = inverse.matrices();
  const MatrixX V = inverse.project_motion(X);
  const MatrixX M = V.transpose() * multiply_mass(full.M_s, V);
  const MatrixX K = V.transpose() * multiply_stiffness(full, V);
  const auto ritz = dense::find_eigenpairs(0.5 * (K + K.transpose()),
                                           0.5 * (M + M.transpose()));
  return {ritz.values, V * ritz.vectors};
}

/// Small models: all eigenpairs at once, none can be missed. Each is accurate
/// to eps times the highest eigenvalue, so the low ones are refined.
Eigenmodes solve_dense(const ElasticInverse& inverse, Eigen::Index count) {
  const StructuralMatrices& full = inverse.matrices();
  const MatrixX lower = MatrixX(full.K);
  const MatrixX K = lower.selfadjointView<Eigen::Lower>();
  const MatrixX M = dense_mass(full);
  const auto all = dense::find_eigenpairs(K, M);
  const Eigen::Index rigid = inverse.rigid_count();
  Eigenmodes modes{all.values.segment(rigid, count),
                   all.vectors.middleCols(rigid, count)};
  constexpr double kEnough = 1e-6;  // of the highest eigenvalue: ten digits
  const double highest = all.values[M.cols() - 1];
  const Eigen::Index low = (modes.lambda.array() < kEnough * highest).count();
  if (low == 0) return modes;
  const Eigenmodes polished = polish(inverse, modes.Phi.leftCols(low));
  modes.lambda.head(low) = polished.lambda;
  modes.Phi.leftCols(low) = polished.Phi;
  return modes;
}

/// The same for a mass that may be singular, by M v = theta (K - s M) v, theta
/// = 1 / (lambda - s): motions without mass have theta = 0.
Eigenmodes solve_dense_any_mass(const ElasticInverse& inverse,
                                Eigen::Index count) {
  constexpr double kMassless = 1e-13;  // of the largest
  const StructuralMatrices& full = inverse.matrices();
  const MatrixX lower = MatrixX(shift_stiffness(full, inverse.shift()));
  const MatrixX A = lower.selfadjointView<Eigen::Lower>();
  const auto all = dense::find_eigenpairs(dense_mass(full), A);
  const double least = kMassless * all.values[all.values.size() - 1];
  const Eigen::Index rank = (all.values.array() > least).count();
  const Eigen::Index elastic = rank - inverse.rigid_count();
  if (count > elastic) refuse_count(count, full.dof_count(), elastic);
  const Eigen::Index taken = count + inverse.rigid_count();
  return polish(inverse, all.vectors.rightCols(taken).leftCols(count));
}

/// @throws NumericalError. Roundoff in K phi is eps |K| |phi| for any lambda,
/// so the tolerance has a part of that size.
void check_residuals(const ElasticInverse& inverse, const Eigenmodes& modes) {
  constexpr double kTolerance = 1e-7;
  const StructuralMatrices& full = inverse.matrices();
  const MatrixX M_Phi = multiply_mass(full.M_s, modes.Phi);
  const MatrixX residual =
      inverse.project_load(multiply_stiffness(full.K, modes.Phi)) -
      M_Phi * modes.lambda.asDiagonal();
  const double roundoff = 1e3 * std::numeric_limits<double>::epsilon() *
                          full.K.diagonal().maxCoeff();
  for (Eigen::Index i = 0; i < modes.lambda.size(); ++i) {
    const double allowed = kTolerance * modes.lambda[i] * M_Phi.col(i).norm() +
                           roundoff * modes.Phi.col(i).norm();
    const double found = residual.col(i).norm();
    if (!(found <= allowed))
      throw NumericalError(fmt::format(
          "eigenmode {}: residual {:.3g} N exceeds its tolerance {:.3g} N.{}",
          i + 1, found, allowed, inverse.conditioning()));
  }
}

/// (K - s M)^-1 restricted to motions M-orthogonal to the known modes, with
/// Spectra's interface.
class ShiftedInverse {
 public:
  using Scalar = double;

  ShiftedInverse(const ElasticInverse& inverse, const MatrixX& known,
                 std::function<void(int)> count_call)
      : inverse_(inverse),
        known_(known),
        M_known_(multiply_mass(inverse.matrices().M_s, known)),
        count_call_(std::move(count_call)) {}

  [[nodiscard]] Eigen::Index rows() const { return known_.rows(); }
  [[nodiscard]] Eigen::Index cols() const { return known_.rows(); }
  void set_shift(double) const {}  // that of the factor

  void perform_op(const double* in, double* out) const {
    count_call_(++calls_);
    const MatrixX load = Eigen::Map<const VectorX>(in, rows());
    Eigen::Map<VectorX>(out, rows()) =
        scale_ * deflate(inverse_.solve_shifted(load));
  }

  /// Scales the operator to order 1 on `x`: Spectra's tolerance has an absolute
  /// part, and eigenvalues depend on the unit of length.
  void scale_by(const MatrixX& x) {
    const MatrixX M_x = multiply_mass(inverse_.matrices().M_s, x);
    const MatrixX y = deflate(inverse_.solve_shifted(M_x));
    scale_ = x.col(0).dot(M_x.col(0)) / y.col(0).dot(M_x.col(0));
  }

  [[nodiscard]] VectorX deflate(const MatrixX& x) const {
    return x - known_ * (M_known_.transpose() * x);
  }

 private:
  const ElasticInverse& inverse_;
  const MatrixX& known_;
  MatrixX M_known_;
  std::function<void(int)> count_call_;
  double scale_ = 1.0;
  mutable int calls_ = 0;
};

/// The inner product of M, with Spectra's interface.
class MassProduct {
 public:
  using Scalar = double;

  explicit MassProduct(const StructuralMatrices& matrices)
      : matrices_(matrices) {}
  [[nodiscard]] Eigen::Index rows() const { return matrices_.dof_count(); }
  [[nodiscard]] Eigen::Index cols() const { return matrices_.dof_count(); }
  void perform_op(const double* in, double* out) const {
    const MatrixX x = Eigen::Map<const VectorX>(in, rows());
    Eigen::Map<VectorX>(out, rows()) = multiply_mass(matrices_.M_s, x);
  }

 private:
  const StructuralMatrices& matrices_;
};

VectorX random_motion(const ShiftedInverse& op, const ElasticInverse& inverse) {
  std::mt19937_64 random{1};
  std::normal_distribution<double> normal;
  MatrixX x(op.rows(), 1);
  for (double& value : x.reshaped()) value = normal(random);
  x = op.deflate(inverse.project_motion(x));
  if (inverse.matrices().is_scalar_mass()) return x;
  // Into the space without motions that have no mass.
  return op.deflate(
      inverse.solve_shifted(multiply_mass(inverse.matrices().M_s, x)));
}

/// The `count` lowest modes that are M-orthogonal to the known ones.
MatrixX search(const ElasticInverse& inverse, const MatrixX& known,
               Eigen::Index count, const Progress& progress) {
  constexpr double kTolerance = 1e-11;
  constexpr Eigen::Index kRestarts = 1000;
  const Eigen::Index room = count_elastic(inverse) - known.cols();
  const Eigen::Index width = std::min(2 * count + 20, room);
  ShiftedInverse op(inverse, known, [&](int calls) {
    // About two solves a column of the width, empirically.
    report(progress, "finding eigenmodes",
           std::min(0.99, 0.5 * calls / static_cast<double>(width)));
  });
  MassProduct mass(inverse.matrices());
  Spectra::SymGEigsShiftSolver<ShiftedInverse, MassProduct,
                               Spectra::GEigsMode::ShiftInvert>
      solver(op, mass, count, width, inverse.shift());
  const VectorX start = random_motion(op, inverse);
  op.scale_by(start);
  solver.init(start.data());
  const Eigen::Index converged =
      solver.compute(Spectra::SortRule::LargestMagn, kRestarts, kTolerance,
                     Spectra::SortRule::SmallestAlge);
  if (converged < count)
    throw NumericalError(fmt::format(
        "eigenmodes: {} of {} converged in {} restarts; request fewer.{}",
        converged, count, kRestarts, inverse.conditioning()));
  if (inverse.matrices().is_scalar_mass()) return solver.eigenvectors();
  // The recursion does not see massless motion and its round-off grows
  // (Nour-Omid, Parlett, Ericsson and Jensen, Math. Comp. 48, 1987).
  return inverse.solve_shifted(
      multiply_mass(inverse.matrices().M_s, solver.eigenvectors()));
}

/// One Krylov space finds repeated eigenvalues only through roundoff. So modes
/// found are deflated and the complement is searched, until it has no
/// eigenvalue below the last requested mode.
Eigenmodes solve_lanczos(const ElasticInverse& inverse, Eigen::Index count,
                         const Progress& progress) {
  const Eigen::Index dofs = inverse.matrices().dof_count();
  Eigenmodes found =
      polish(inverse, search(inverse, MatrixX(dofs, 0), count, progress));
  for (Eigen::Index more = 1;; more *= 2) {
    const Eigen::Index left = count_elastic(inverse) - found.Phi.cols();
    more = std::min(more, left - 1);
    const MatrixX rest = search(inverse, found.Phi, more, progress);
    const double lowest = polish(inverse, rest).lambda[0];
    if (lowest >= found.lambda[count - 1]) break;
    MatrixX both(dofs, found.Phi.cols() + more);
    both << found.Phi, rest;
    found = polish(inverse, both);
  }
  return {found.lambda.head(count), found.Phi.leftCols(count)};
}

}  // namespace

Eigenmodes find_eigenmodes(const ElasticInverse& inverse, int count,
                           const Progress& progress) {
  LIMBER_EXPECT(count >= 0);
  const Eigen::Index dofs = inverse.matrices().dof_count();
  const Eigen::Index elastic = count_elastic(inverse);
  if (count > elastic) refuse_count(count, dofs, elastic);
  if (count == 0) return {VectorX(0), MatrixX(dofs, 0)};
  // Dense costs dofs^3, Lanczos about dofs count^2.
  const bool is_dense = dofs <= 600 || (dofs <= 2000 && 10 * count > elastic) ||
                        3 * count > elastic;
  const auto solve =
      inverse.matrices().is_scalar_mass() ? solve_dense : solve_dense_any_mass;
  Eigenmodes modes = is_dense ? solve(inverse, count)
                              : solve_lanczos(inverse, count, progress);
  check_residuals(inverse, modes);
  return modes;
}

}  // namespace limber::fem
