// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/matrices/matrix_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "limber/common/errors.hpp"
#include "limber/fem/linalg/cholesky.hpp"

namespace limber::flexbody {
namespace {

using fem::SparseMatrix;

struct Asymmetry {
  double largest = 0.0;     ///< |A_ij - A_ji|
  Eigen::Index row = 0;     ///< where
  Eigen::Index column = 0;  ///< where
  Eigen::Index alone = 0;   ///< off-diagonal entries without a partner
  Eigen::Index paired = 0;  ///< and with one
};

Asymmetry find_asymmetry(const SparseMatrix& A) {
  const SparseMatrix T = A.transpose();
  Asymmetry found;
  const auto compare = [&](Eigen::Index i, Eigen::Index j, double difference) {
    if (std::abs(difference) <= found.largest) return;
    found.largest = std::abs(difference);
    found.row = i;
    found.column = j;
  };
  for (Eigen::Index j = 0; j < A.outerSize(); ++j) {
    SparseMatrix::InnerIterator a(A, j);
    SparseMatrix::InnerIterator t(T, j);
    while (a || t) {
      if (a && t && a.row() == t.row()) {
        compare(a.row(), j, a.value() - t.value());
        if (a.row() != j && a.value() != 0.0) ++found.paired;
        ++a;
        ++t;
      } else if (a && (!t || a.row() < t.row())) {
        compare(a.row(), j, a.value());
        if (a.value() != 0.0) ++found.alone;
        ++a;
      } else {
        compare(t.row(), j, t.value());
        ++t;
      }
    }
  }
  return found;
}

/// Largest entry that is not a support's.
double find_largest(const SparseMatrix& A) {
  double largest = 0.0;
  for (Eigen::Index j = 0; j < A.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(A, j); it; ++it)
      if (it.value() < kHeld) largest = std::max(largest, std::abs(it.value()));
  return largest;
}

void check_finite(const MatrixSystem& system, const std::string& file,
                  const SparseMatrix& A) {
  for (Eigen::Index j = 0; j < A.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(A, j); it; ++it)
      if (!std::isfinite(it.value()))
        throw InputError(fmt::format(
            "{}: the entry of {} and {} is {}; expected a finite number", file,
            system.name_row(it.row()), system.name_row(j), it.value()));
}

void check_symmetry(const MatrixSystem& system, const std::string& file,
                    const SparseMatrix& A) {
  constexpr double kAllowed = 1e-6;  // of the largest entry
  check_finite(system, file, A);
  const Asymmetry found = find_asymmetry(A);
  if (found.largest <= kAllowed * find_largest(A)) return;
  if (found.paired == 0 && found.alone > 0)
    throw InputError(fmt::format(
        "{}: all off-diagonal entries are in one triangle and the file does "
        "not state that it is symmetric; write 'symmetric' into its header, or "
        "both triangles",
        file));
  throw InputError(fmt::format(
      "{}: it is not symmetric: the entries of {} and {} differ by {:.3g}; "
      "expected the symmetric matrix of an undamped structure at rest",
      file, system.name_row(found.row), system.name_row(found.column),
      found.largest));
}

void check_minors(const MatrixSystem& system, const std::string& file,
                  const std::string& what, const SparseMatrix& A) {
  constexpr double kRoundoff = 1e-6;
  constexpr double kDoubled = 1.5;
  const VectorX diagonal = A.diagonal();
  Eigen::Index lowest = 0;
  if (diagonal.minCoeff(&lowest) < 0.0)
    throw InputError(
        fmt::format("{}: the {} of {} is {:.3g}; expected none below 0 on the "
                    "diagonal",
                    file, what, system.name_row(lowest), diagonal[lowest]));
  double worst = 1.0 + kRoundoff;
  Eigen::Index row = -1;
  Eigen::Index column = -1;
  const double least = 1e-14 * find_largest(A);
  for (Eigen::Index j = 0; j < A.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(A, j); it; ++it) {
      const double size = std::abs(it.value());
      if (it.row() <= j || size <= least) continue;
      const double bound = std::sqrt(diagonal[it.row()] * diagonal[j]);
      if (!(size > worst * bound)) continue;
      worst = bound > 0.0 ? size / bound : 1e300;
      row = it.row();
      column = j;
    }
  if (row < 0) return;
  throw InputError(fmt::format(
      "{}: the {} between {} and {} is {:.4g} of the largest value that their "
      "diagonal entries allow, so it is not positive semidefinite{}",
      file, what, system.name_row(row), system.name_row(column), worst,
      worst > kDoubled && worst < 2.5
          ? "; were both triangles added where the file has both, so that "
            "off-diagonal entries are doubled?"
          : "; expected the matrix of a structure without a follower load, all "
            "of it"));
}

}  // namespace

void check_symmetry(const MatrixSystem& system) {
  check_symmetry(system, system.stiffness_file, system.K);
  check_symmetry(system, system.mass_file, system.M);
}

void check_minors(const MatrixSystem& system) {
  check_minors(system, system.stiffness_file, "stiffness", system.K);
  check_minors(system, system.mass_file, "mass", system.M);
}

void check_positive_mass(const MatrixSystem& system) {
  const double allowed =
      std::max(1e-8, std::pow(10.0, 2.0 - static_cast<double>(system.digits)));
  const VectorX diagonal = system.M.diagonal();
  const VectorX scale =
      (diagonal.array() > 0.0)
          .select(diagonal.cwiseMax(1e-300).cwiseSqrt().cwiseInverse(), 0.0);
  SparseMatrix lower = system.M.triangularView<Eigen::Lower>();
  bool is_diagonal = true;
  for (Eigen::Index j = 0; j < lower.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(lower, j); it; ++it) {
      it.valueRef() *= scale[it.row()] * scale[j];
      is_diagonal = is_diagonal && (it.row() == j || it.value() == 0.0);
    }
  if (is_diagonal) return;
  SparseMatrix shift(lower.rows(), lower.cols());
  shift.setIdentity();
  shift.diagonal() =
      (diagonal.array() > 0.0)
          .select(VectorX::Constant(diagonal.size(), allowed), 1.0);
  lower += shift;
  try {
    const fem::SparseCholesky factor(lower, fem::order_nodes(lower), "mass");
  } catch (const NumericalError&) {
    throw InputError(fmt::format(
        "{}: the mass matrix is not positive semidefinite: some motion has a "
        "negative kinetic energy. Expected the mass of the whole model, with "
        "the sign of its off-diagonal entries",
        system.source));
  }
}

}  // namespace limber::flexbody
