// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/bodies/coupled_modes.hpp"

namespace limber::dynamics {

CoupledModes::CoupledModes(Eigen::Index modes)
    : A_(MatrixX::Identity(modes, modes)),
      factors_(modes),
      inverse_(A_),
      product_(VectorX::Zero(modes)) {}

bool CoupledModes::factor(const VectorX& diagonal, const MatrixX& K) {
  A_ = K;
  A_.diagonal() += diagonal;
  solves_ = 0;
  return factors_.factor(A_);
}

void CoupledModes::solve(Eigen::Ref<VectorX> x) {
  if (solves_ == kSolvesByFactors) {
    product_.noalias() = inverse_ * x;
    x = product_;
    return;
  }
  factors_.solve(x);
  if (++solves_ == kSolvesByFactors) inverse_ = factors_.inverse();
}

void CoupledModes::solve_rows(const Eigen::Ref<const Matrix6X>& rows,
                              Eigen::Ref<Matrix6X> result) const {
  factors_.solve_rows(rows, result);
}

}  // namespace limber::dynamics
