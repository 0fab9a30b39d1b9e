// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/newton/coupled_modes.hpp"

namespace limber::dynamics {

CoupledModes::CoupledModes(Eigen::Index modes)
    : A_(MatrixX::Identity(modes, modes)),
      lu_(A_),
      inverse_(A_),
      scratch_(VectorX::Zero(modes)) {}

bool CoupledModes::factor(const VectorX& diagonal, const MatrixX& K) {
  A_ = K;
  A_.diagonal() += diagonal;
  lu_.compute(A_);
  solves_ = 0;
  const auto pivots = lu_.matrixLU().diagonal();
  return pivots.allFinite() && (pivots.array() != 0.0).all();
}

void CoupledModes::solve(Eigen::Ref<VectorX> x) {
  if (solves_ == kSolvesByFactors) {
    scratch_.noalias() = inverse_ * x;
    x = scratch_;
    return;
  }
  scratch_.noalias() = lu_.permutationP() * x;
  lu_.matrixLU().triangularView<Eigen::UnitLower>().solveInPlace(scratch_);
  lu_.matrixLU().triangularView<Eigen::Upper>().solveInPlace(scratch_);
  x = scratch_;
  if (++solves_ == kSolvesByFactors) inverse_ = lu_.inverse();
}

void CoupledModes::solve_rows(const Eigen::Ref<const Matrix6X>& rows,
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

}  // namespace limber::dynamics
