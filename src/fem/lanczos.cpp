// SPDX-License-Identifier: BSD-3-Clause
#include "fem/lanczos.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace limber::fem {
namespace {
// A sphere's seven-fold eigenvalues fit; wider blocks waste solves.
constexpr Eigen::Index kBlock = 8;
}  // namespace

BlockLanczos::BlockLanczos(const ElasticInverse& inverse)
    : inverse_(inverse),
      limit_(inverse.matrices().dof_count() - inverse.rigid_count()),
      Q_(inverse.matrices().dof_count(), 0),
      MQ_(Q_) {
  restart_direction();
}

MatrixX BlockLanczos::random_block() {
  std::normal_distribution<double> normal;
  MatrixX block(inverse_.matrices().dof_count(), kBlock);
  for (double& value : block.reshaped()) value = normal(random_);
  return inverse_.project_motion(block);
}

void BlockLanczos::orthogonalise(MatrixX& block, MatrixX& coefficients) const {
  coefficients = MatrixX::Zero(used_, block.cols());
  for (int pass = 0; pass < 2; ++pass) {
    const MatrixX part = MQ_.leftCols(used_).transpose() * block;
    block.noalias() -= Q_.leftCols(used_) * part;
    coefficients += part;
  }
}

MatrixX BlockLanczos::factor_block(const MatrixX& block, MatrixX& R) const {
  constexpr double kDependent = 1e-10;
  const Eigen::Index room = std::max<Eigen::Index>(0, limit_ - used_);
  const Eigen::Index width = std::min(block.cols(), room);
  R = MatrixX::Zero(block.cols(), block.cols());
  MatrixX Q(block.rows(), width);
  MatrixX MQ(block.rows(), width);
  Eigen::Index kept = 0;
  const SparseMatrix& M_s = inverse_.matrices().M_s;
  for (Eigen::Index j = 0; j < block.cols(); ++j) {
    MatrixX column = block.col(j);
    const double before =
        std::sqrt(column.col(0).dot(multiply_mass(M_s, column).col(0)));
    for (int pass = 0; pass < 2; ++pass) {
      const VectorX part = MQ.leftCols(kept).transpose() * column.col(0);
      column.col(0) -= Q.leftCols(kept) * part;
      R.col(j).head(kept) += part;
    }
    MatrixX M_column = multiply_mass(M_s, column);
    const double norm =
        std::sqrt(std::max(0.0, column.col(0).dot(M_column.col(0))));
    if (norm <= kDependent * before || kept == width) continue;
    R(kept, j) = norm;
    Q.col(kept) = column.col(0) / norm;
    MQ.col(kept) = M_column.col(0) / norm;
    ++kept;
  }
  R.conservativeResize(kept, Eigen::NoChange);
  return Q.leftCols(kept);
}

void BlockLanczos::restart_direction() {
  MatrixX block = random_block();
  MatrixX unused;
  orthogonalise(block, unused);
  MatrixX R;
  next_ = factor_block(block, R);
}

bool BlockLanczos::extend() {
  const Eigen::Index width = next_.cols();
  if (width == 0) return false;
  const Eigen::Index total = used_ + width;
  if (total > Q_.cols()) {
    const Eigen::Index capacity = std::min(limit_, 2 * total + 8 * kBlock);
    Q_.conservativeResize(next_.rows(), capacity);
    MQ_.conservativeResize(next_.rows(), capacity);
  }
  Q_.middleCols(used_, width) = next_;
  const MatrixX M_next = multiply_mass(inverse_.matrices().M_s, next_);
  MQ_.middleCols(used_, width) = M_next;
  used_ = total;
  MatrixX block = inverse_.solve_shifted(M_next);
  MatrixX H;
  orthogonalise(block, H);
  T_.conservativeResize(used_, used_);
  T_.rightCols(width) = H;
  T_.bottomRows(width) = H.transpose();
  MatrixX R;
  next_ = factor_block(block, R);
  update_ritz(R);
  if (next_.cols() == 0) restart_direction();
  return true;
}

void BlockLanczos::update_ritz(const MatrixX& R) {
  const MatrixX symmetric = 0.5 * (T_ + T_.transpose());
  const Eigen::SelfAdjointEigenSolver<MatrixX> ritz(symmetric);
  theta_ = ritz.eigenvalues().reverse();
  S_ = ritz.eigenvectors().rowwise().reverse();
  const Eigen::Index width = R.cols();
  residuals_ = (R * S_.bottomRows(width)).colwise().norm().transpose();
  residuals_.array() /= theta_.array().abs();
}

MatrixX BlockLanczos::vectors(Eigen::Index count) const {
  return Q_.leftCols(used_) * S_.leftCols(count);
}

}  // namespace limber::fem
