// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/analysis/principal_basis.hpp"

#include <Eigen/SparseCore>
#include <algorithm>

#include "limber/common/dense/linear_solve.hpp"
#include "limber/common/dense/qr.hpp"
#include "limber/common/dense/singular_values.hpp"
#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/dynamics/analysis/group_motion.hpp"
#include "limber/dynamics/system/linked_groups.hpp"

namespace limber::dynamics {
namespace {

using Index = Eigen::Index;

/// Columns orthogonal to Q's of full rank.
MatrixX find_complement(const MatrixX& Q) {
  if (Q.cols() == 0) return MatrixX::Identity(Q.rows(), Q.rows());
  return dense::find_q(Q, Q.rows()).rightCols(Q.rows() - Q.cols());
}

/// Null space of the rows, normalised to unit length.
MatrixX find_null_space(MatrixX rows) {
  constexpr double kDependent = 1e-10;
  rows.rowwise().normalize();
  const Index n = rows.cols();
  if (rows.rows() == 0) return MatrixX::Identity(n, n);
  const auto [Q, rank] = dense::find_pivoted_q(rows.transpose(), kDependent);
  return Q.rightCols(n - rank);
}

/// Translations of each group that nothing ties to the world.
MatrixX find_free_translations(const SystemModel& model,
                               const SmallMotion& motion) {
  MatrixX drift(motion.size(), 0);
  for (const auto& group : find_free_groups(model)) {
    if (motion.places[index(group.front())] < 0) continue;  // not of it
    drift.conservativeResize(Eigen::NoChange, drift.cols() + 3);
    drift.rightCols<3>().setZero();
    for (const BodyIndex b : group) {
      drift.rightCols<3>().middleRows<3>(motion.places[index(b)]).setIdentity();
    }
  }
  return drift;
}

bool is_symmetric(const MatrixX& S) {
  constexpr double kSame = 1e-12;
  return (S - S.transpose()).norm() <= kSame * S.norm();
}

using Sparse = Eigen::SparseMatrix<double>;

/// Of M = U' U, which has a block for each body.
struct MassRoot {
  Sparse U;
  Sparse inverse;
};

MassRoot find_mass_root(const SystemModel& model, const SmallMotion& motion) {
  std::vector<Eigen::Triplet<double>> U;
  std::vector<Eigen::Triplet<double>> inverse;
  for (const BodyIndex b : motion.bodies) {
    const Index place = motion.places[index(b)];
    const Index modes = model.bodies[index(b)].modes;
    const Index size = (place < 0 ? 0 : 6) + modes;
    const Index first = place < 0 ? motion.modes[index(b)] : place;
    const auto L =
        dense::find_cholesky(MatrixX(motion.M.block(first, first, size, size)));
    LIMBER_EXPECT(L.has_value());
    const MatrixX to_x =
        dense::solve_lower_transposed(*L, MatrixX::Identity(size, size));
    for (Index j = 0; j < size; ++j) {
      for (Index i = 0; i <= j; ++i) {
        U.emplace_back(first + i, first + j, (*L)(j, i));
        inverse.emplace_back(first + i, first + j, to_x(i, j));
      }
    }
  }
  MassRoot root{Sparse(motion.size(), motion.size()),
                Sparse(motion.size(), motion.size())};
  root.U.setFromTriplets(U.begin(), U.end());
  root.inverse.setFromTriplets(inverse.begin(), inverse.end());
  return root;
}

/// Of one linked group, with its own sizes.
PrincipalBasis find_group_basis(const SystemModel& model,
                                const SmallMotion& motion) {
  constexpr double kNothing = 1e-9;
  constexpr double kSafety = 10.0;  // of round-off
  const Index n = motion.size();
  const auto [U, to_x] = find_mass_root(model, motion);
  MatrixX drift = find_free_translations(model, motion);
  if (drift.cols() > 0) {  // separate: momentum is conserved
    drift = dense::find_q(U * drift, drift.cols());
  }
  const MatrixX holds = motion.find_holds() * to_x;
  MatrixX rows(holds.rows() + drift.cols(), n);
  rows.topRows(holds.rows()) = holds;
  rows.bottomRows(drift.cols()) = drift.transpose();
  const MatrixX open = find_null_space(rows);
  MatrixX free = drift;
  if (open.cols() > 0) {
    const auto scale = [&to_x = to_x](const MatrixX& forces) -> MatrixX {
      return to_x.transpose() * MatrixX(forces * to_x);
    };
    const MatrixX rest = scale(motion.rest);
    const MatrixX noise = scale(motion.noise) * open;
    const auto svd = dense::find_right_singular_form(rest * open);
    const double least = kNothing * rest.norm() + kSafety * noise.norm();
    const Index resisted = (svd.values.array() > least).count();
    const Index loose = open.cols() - resisted;
    free.conservativeResize(n, drift.cols() + loose);
    free.rightCols(loose) = open * svd.V.rightCols(loose);
  }
  // Orthogonal changes of columns leave the norms of symmetry as they are.
  const Index held = n - free.cols();
  PrincipalBasis basis{MatrixX(n, n), free.cols(), drift.cols(), {}, true};
  basis.Q.leftCols(free.cols()) = to_x * free;
  if (held > 0) basis.Q.rightCols(held) = to_x * find_complement(free);
  const MatrixX S = motion.project_stiffness(basis.Q);
  basis.is_symmetric = is_symmetric(S);
  if (held == 0) return basis;
  const MatrixX block = S.bottomRightCorner(held, held);
  const auto eigen =
      dense::find_eigenpairs(MatrixX(0.5 * (block + block.transpose())));
  basis.squares = eigen.values;
  basis.Q.rightCols(held) = (basis.Q.rightCols(held) * eigen.vectors).eval();
  return basis;
}

/// Places columns of groups' bases one after another in that of the whole.
class Columns {
 public:
  explicit Columns(MatrixX& Q) : Q_(Q) {}
  void append(const GroupMotion& group, const MatrixX& columns) {
    Q_(group.coordinates, Eigen::seqN(count_, columns.cols())) = columns;
    count_ += columns.cols();
  }

 private:
  MatrixX& Q_;
  Index count_ = 0;
};

/// A column of a group's basis that something holds.
struct Held {
  double square;  // of its frequency [1/s^2]
  std::size_t group;
  Index column;
};

std::vector<Held> sort_held(const std::vector<PrincipalBasis>& bases) {
  std::vector<Held> held;
  for (std::size_t g = 0; g < bases.size(); ++g) {
    for (Index i = 0; i < bases[g].squares.size(); ++i) {
      held.push_back({bases[g].squares[i], g, bases[g].free + i});
    }
  }
  std::stable_sort(held.begin(), held.end(), [](const Held& a, const Held& b) {
    return a.square < b.square;
  });
  return held;
}

}  // namespace

PrincipalBasis find_principal_basis(const SystemModel& model,
                                    const SmallMotion& motion) {
  const std::vector<GroupMotion> groups = split_groups(model, motion);
  std::vector<PrincipalBasis> bases;
  PrincipalBasis all;
  for (const GroupMotion& group : groups) {
    bases.push_back(find_group_basis(model, group.motion));
    all.free += bases.back().free;
    all.drift += bases.back().drift;
    all.is_symmetric = all.is_symmetric && bases.back().is_symmetric;
  }
  const Index n = motion.size();
  all.Q = MatrixX::Zero(n, n);
  Columns columns(all.Q);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    columns.append(groups[g], bases[g].Q.leftCols(bases[g].drift));
  }
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const PrincipalBasis& basis = bases[g];
    columns.append(groups[g],
                   basis.Q.middleCols(basis.drift, basis.free - basis.drift));
  }
  all.squares.resize(n - all.free);
  Index i = 0;
  for (const Held& held : sort_held(bases)) {
    columns.append(groups[held.group], bases[held.group].Q.col(held.column));
    all.squares[i++] = held.square;
  }
  return all;
}

bool is_conservative(const SmallMotion& motion, const PrincipalBasis& basis) {
  return motion.relaxations.empty() && motion.D.isZero(0.0) &&
         basis.is_symmetric;
}

}  // namespace limber::dynamics
