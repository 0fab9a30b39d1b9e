// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/model/interface_motion.hpp"

#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/rotation.hpp"

namespace limber::flexbody {
namespace {

/// sum w_i (d.d I - d d^T) [m^2]
Matrix3 calc_second_moment(const Matrix3X& d, const VectorX& weights) {
  const Matrix3 S = d * weights.asDiagonal() * d.transpose();
  return S.trace() * Matrix3::Identity() - S;
}

}  // namespace

InterfaceMotion::InterfaceMotion(std::vector<int> nodes, VectorX weights,
                                 const Matrix3X& x, double body_size)
    : nodes_(std::move(nodes)), dofs_(3 * x.cols()) {
  const auto count = static_cast<Eigen::Index>(nodes_.size());
  LIMBER_EXPECT(count > 0 && weights.size() == count);
  const Matrix3X own = x(Eigen::all, nodes_);
  p_ = own * weights;
  const Matrix3X d = own.colwise() - p_;
  const auto moments = dense::find_eigenpairs(calc_second_moment(d, weights));
  constexpr double kPoint = 1e-6;  // of the body's size
  constexpr double kLine = 1e-8;   // of the largest moment
  const double largest = moments.values[2];
  const bool is_point = largest < std::pow(kPoint * body_size, 2);
  Matrix3 inverse = Matrix3::Zero();
  axes_.resize(3, 0);
  for (int k = 0; k < 3 && !is_point; ++k) {
    if (moments.values[k] < kLine * largest) continue;
    const Vector3 axis = moments.vectors.col(k);
    inverse += axis * axis.transpose() / moments.values[k];
    axes_.conservativeResize(3, ++rank_);
    axes_.col(rank_ - 1) = axis;
  }
  map_.resize(6, 3 * count);
  for (Eigen::Index i = 0; i < count; ++i) {
    map_.block<3, 3>(0, 3 * i) = weights[i] * Matrix3::Identity();
    map_.block<3, 3>(3, 3 * i) = weights[i] * inverse * skew(d.col(i));
  }
}

Matrix6X InterfaceMotion::apply(const MatrixX& fields) const {
  LIMBER_EXPECT(fields.rows() == dofs_);
  Matrix6X motion = Matrix6X::Zero(6, fields.cols());
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    motion += map_.middleCols<3>(3 * static_cast<Eigen::Index>(i)) *
              fields.middleRows<3>(3 * nodes_[i]);
  return motion;
}

MatrixX InterfaceMotion::spread(const Matrix6X& wrenches) const {
  MatrixX forces = MatrixX::Zero(dofs_, wrenches.cols());
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    forces.middleRows<3>(3 * nodes_[i]) +=
        map_.middleCols<3>(3 * static_cast<Eigen::Index>(i)).transpose() *
        wrenches;
  return forces;
}

}  // namespace limber::flexbody
