// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/dense/lu_factors.hpp"

namespace limber::dense {

LuFactors::LuFactors(Eigen::Index n)
    : lu_(MatrixX::Identity(n, n)), scratch_(VectorX::Zero(n)) {}

bool LuFactors::factor(const MatrixX& A) {
  lu_.compute(A);
  const auto pivots = lu_.matrixLU().diagonal();
  return pivots.allFinite() && (pivots.array() != 0.0).all();
}

void LuFactors::solve(Eigen::Ref<VectorX> x) {
  scratch_.noalias() = lu_.permutationP() * x;
  lu_.matrixLU().triangularView<Eigen::UnitLower>().solveInPlace(scratch_);
  lu_.matrixLU().triangularView<Eigen::Upper>().solveInPlace(scratch_);
  x = scratch_;
}

void LuFactors::solve_rows(const Eigen::Ref<const Matrix6X>& rows,
                           Eigen::Ref<Matrix6X> result) const {
  const auto& place = lu_.permutationP().indices();
  for (Eigen::Index k = 0; k < rows.cols(); ++k) {
    result.col(place[k]) = rows.col(k);
  }
  lu_.matrixLU()
      .triangularView<Eigen::UnitLower>()
      .transpose()
      .solveInPlace<Eigen::OnTheRight>(result);
  lu_.matrixLU()
      .triangularView<Eigen::Upper>()
      .transpose()
      .solveInPlace<Eigen::OnTheRight>(result);
}

MatrixX LuFactors::inverse() const { return lu_.inverse(); }

}  // namespace limber::dense
