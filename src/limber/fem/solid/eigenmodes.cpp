// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/solid/eigenmodes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
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

/// A = (K - s M)^-1 M restricted to motions that are M-orthogonal to the known
/// modes. M-symmetric, with eigenvalues theta = 1 / (lambda - s).
class ShiftedInverse {
 public:
  ShiftedInverse(const ElasticInverse& inverse, const MatrixX& known)
      : inverse_(inverse), known_(known), M_known_(multiply_mass(known)) {}

  [[nodiscard]] MatrixX multiply_mass(const MatrixX& X) const {
    return fem::multiply_mass(inverse_.matrices().M_s, X);
  }
  /// A V of M V.
  [[nodiscard]] MatrixX apply(const MatrixX& MV) const {
    return deflate(inverse_.solve_shifted(MV));
  }
  [[nodiscard]] MatrixX make_random(Eigen::Index count) const {
    // Others than those with which the known modes were found: of a repeated
    // eigenvalue these modes are all that the same vectors hold.
    std::mt19937_64 random(static_cast<std::uint64_t>(1 + known_.cols()));
    std::normal_distribution<double> normal;
    MatrixX X(known_.rows(), count);
    for (double& value : X.reshaped()) value = normal(random);
    X = deflate(inverse_.project_motion(X));
    if (inverse_.matrices().is_scalar_mass()) return X;
    // Into the space without motions that have no mass.
    return apply(multiply_mass(X));
  }

 private:
  [[nodiscard]] MatrixX deflate(const MatrixX& X) const {
    return X - known_ * (M_known_.transpose() * X);
  }

  const ElasticInverse& inverse_;
  const MatrixX& known_;
  MatrixX M_known_;
};

/// Columns that a Krylov space grows by: the factor is read once for all of
/// them, but more columns take more vectors to converge. They find as many
/// modes of one eigenvalue.
constexpr Eigen::Index kBlock = 8;

/// A growing M-orthonormal basis V and its T = V' M A V.
struct KrylovSpace {
  MatrixX V;  ///< as many columns as may be needed, `size` of them set
  Eigen::Index size = 0;
  MatrixX T;       ///< size x size
  MatrixX G;       ///< R' M R, R the columns of A V - V T that are not zero
  MatrixX next;    ///< M-orthonormal basis of R
  MatrixX M_next;  ///< M times it

  [[nodiscard]] auto basis() const { return V.leftCols(size); }
};

/// Sets `next` to a basis of R without directions of round-off.
/// @param largest M-norm of which round-off is a part
void set_next(const ShiftedInverse& op, const MatrixX& R, const MatrixX& MR,
              double largest, KrylovSpace& space) {
  constexpr double kRoundoff = 1e-13;    // of `largest`
  constexpr double kIndependent = 1e-7;  // of a column
  space.G = R.transpose() * MR;
  VectorX scale = space.G.diagonal().cwiseMax(0.0).cwiseSqrt();
  for (double& norm : scale) {
    norm = norm > kRoundoff * largest ? 1.0 / norm : 0.0;
  }
  space.next = R * scale.asDiagonal();
  space.M_next = MR * scale.asDiagonal();
  for (int pass = 0; pass < 2; ++pass) {
    const MatrixX gram = space.next.transpose() * space.M_next;
    const auto pairs =
        dense::find_eigenpairs(MatrixX(0.5 * (gram + gram.transpose())));
    const Eigen::Index kept =
        (pairs.values.array() > kIndependent * kIndependent).count();
    const MatrixX axes =
        pairs.vectors.rightCols(kept) *
        pairs.values.tail(kept).cwiseSqrt().cwiseInverse().asDiagonal();
    space.next = space.next * axes;
    space.M_next = space.M_next * axes;
  }
  space.M_next = op.multiply_mass(space.next);
}

/// Moves `next` into V and finds the one after.
void extend(const ShiftedInverse& op, KrylovSpace& space) {
  const Eigen::Index old = space.size;
  const Eigen::Index block = space.next.cols();
  space.V.middleCols(old, block) = space.next;
  space.size += block;
  MatrixX R = op.apply(space.M_next);
  MatrixX T = MatrixX::Zero(space.size, space.size);
  T.topLeftCorner(old, old) = space.T;
  MatrixX MR;
  for (int pass = 0; pass < 2; ++pass) {  // the second removes round-off
    MR = op.multiply_mass(R);
    const MatrixX C = space.basis().transpose() * MR;
    R -= space.basis() * C;
    T.rightCols(block) += C;
  }
  T.bottomLeftCorner(block, old) = T.topRightCorner(old, block).transpose();
  space.T = std::move(T);
  set_next(op, R, MR, space.T.diagonal().maxCoeff(), space);
}

/// Replaces V by its `kept` vectors of largest theta.
void restart(const dense::Eigenpairs& ritz, Eigen::Index kept,
             KrylovSpace& space) {
  const MatrixX V = space.basis() * ritz.vectors.rightCols(kept);
  space.V.leftCols(kept) = V;
  space.size = kept;
  space.T = ritz.values.tail(kept).asDiagonal();
}

/// The `count` lowest modes that are M-orthogonal to the known ones, or fewer
/// if one Krylov space holds no more.
MatrixX search(const ElasticInverse& inverse, const MatrixX& known,
               Eigen::Index count, const Progress& progress) {
  constexpr double kTolerance = 1e-10;  // of theta
  constexpr int kMostBlocks = 1000;
  const Eigen::Index room = count_elastic(inverse) - known.cols();
  const Eigen::Index block = std::min(kBlock, room);
  const Eigen::Index most = std::min(2 * count + 8 * block, room);
  const ShiftedInverse op(inverse, known);
  KrylovSpace space;
  space.V.resize(known.rows(), most + block);
  const MatrixX start = op.make_random(block);
  set_next(op, start, op.multiply_mass(start), 0.0, space);
  double residual = 1.0;
  for (int i = 0; i < kMostBlocks; ++i) {
    extend(op, space);
    const dense::Eigenpairs ritz =
        dense::find_eigenpairs(MatrixX(0.5 * (space.T + space.T.transpose())));
    const Eigen::Index found = std::min(count, space.size);
    const MatrixX Y = ritz.vectors.rightCols(found);
    const MatrixX last = Y.bottomRows(space.G.cols());
    const VectorX squares = (last.transpose() * space.G * last).diagonal();
    residual =
        (squares.array().max(0.0).sqrt() / ritz.values.tail(found).array())
            .maxCoeff();
    const bool is_whole = space.next.cols() == 0 || space.size >= room;
    if (is_whole || (found == count && residual <= kTolerance)) {
      // Once more, which removes stiff motion, and round-off of motion without
      // mass, which grows in the space (Nour-Omid, Parlett, Ericsson and
      // Jensen, Math. Comp. 48, 1987).
      return op.apply(op.multiply_mass(space.basis() * Y));
    }
    report(progress, "finding eigenmodes",
           std::clamp(std::log(residual) / std::log(kTolerance), 0.0, 0.99));
    if (space.size > most) {
      restart(ritz, std::min(count + block, space.size), space);
    }
  }
  throw NumericalError(fmt::format(
      "eigenmodes: {} did not converge in {} blocks: their residual is {:.3g}, "
      "{:.0g} is required. Request fewer.{}",
      count, kMostBlocks, residual, kTolerance, inverse.conditioning()));
}

/// Whether more modes may share an eigenvalue than a block finds.
bool may_lack_modes(const VectorX& lambda) {
  constexpr double kCluster = 0.05;
  for (Eigen::Index i = 0; i + kBlock <= lambda.size(); ++i) {
    if (lambda[i + kBlock - 1] <= (1.0 + kCluster) * lambda[i]) return true;
  }
  return false;
}

/// A Krylov space holds no more modes of one eigenvalue than its blocks have
/// columns. Then modes found are deflated and the complement is searched, until
/// it has no eigenvalue below the last requested mode.
Eigenmodes solve_lanczos(const ElasticInverse& inverse, Eigen::Index count,
                         const Progress& progress) {
  const Eigen::Index dofs = inverse.matrices().dof_count();
  Eigenmodes found =
      polish(inverse, search(inverse, MatrixX(dofs, 0), count, progress));
  for (Eigen::Index more = 1;; more *= 2) {
    const Eigen::Index lacking = count - found.Phi.cols();
    if (lacking <= 0 && !may_lack_modes(found.lambda.head(count))) break;
    const MatrixX rest =
        search(inverse, found.Phi, std::max(more, lacking), progress);
    const double lowest = polish(inverse, rest).lambda[0];
    if (lacking <= 0 && lowest >= found.lambda[count - 1]) break;
    MatrixX both(dofs, found.Phi.cols() + rest.cols());
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
