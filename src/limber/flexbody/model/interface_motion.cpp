// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/model/interface_motion.hpp"

#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/rotation.hpp"

namespace limber::flexbody {
namespace {

/// sum (y.d I - d y^T) [m^2]
Matrix3 calc_second_moment(const Matrix3X& d, const Matrix3X& y) {
  const Matrix3 S = d * y.transpose();
  return S.trace() * Matrix3::Identity() - S;
}

}  // namespace

Matrix3 invert_second_moment(const Matrix3& A, const Matrix3X& axes) {
  if (axes.cols() == 3) return A.inverse();
  if (axes.cols() == 0) return Matrix3::Zero();
  const Eigen::Matrix<double, 3, 2> X = axes;
  const Eigen::Matrix2d projected = X.transpose() * A * X;
  return X * projected.inverse() * X.transpose();
}

InterfaceMotion::InterfaceMotion(std::vector<int> nodes, const VectorX& weights,
                                 const Matrix3X& moments, const Matrix3X& x,
                                 double body_size)
    : nodes_(std::move(nodes)), dofs_(3 * x.cols()) {
  const auto count = static_cast<Eigen::Index>(nodes_.size());
  LIMBER_EXPECT(count > 0 && weights.size() == count &&
                moments.cols() == count);
  const Matrix3X own = x(Eigen::all, nodes_);
  p_ = own * weights;
  const Matrix3X d = own.colwise() - p_;
  const Matrix3 A = calc_second_moment(d, moments);
  const auto second =
      dense::find_eigenpairs(Matrix3(0.5 * (A + A.transpose())));
  constexpr double kPoint = 1e-6;  // of the body's size
  constexpr double kLine = 1e-8;   // of the largest moment
  const double largest = second.values[2];
  const bool is_point = largest < std::pow(kPoint * body_size, 2);
  axes_.resize(3, 0);
  for (int k = 0; k < 3 && !is_point; ++k) {
    if (second.values[k] < kLine * largest) continue;
    axes_.conservativeResize(3, ++rank_);
    axes_.col(rank_ - 1) = second.vectors.col(k);
  }
  const Matrix3 inverse = invert_second_moment(A, axes_);
  map_.resize(6, 3 * count);
  for (Eigen::Index i = 0; i < count; ++i) {
    map_.block<3, 3>(0, 3 * i) = weights[i] * Matrix3::Identity();
    map_.block<3, 3>(3, 3 * i) = inverse * skew(Vector3(moments.col(i)));
  }
}

InterfaceMotion InterfaceMotion::of_frame(int node, int rotation,
                                          const Vector3& p,
                                          const Matrix3X& axes,
                                          Eigen::Index count) {
  InterfaceMotion motion;
  motion.nodes_ = {node, rotation};
  motion.map_ = Matrix6X::Zero(6, 6);
  motion.map_.topLeftCorner<3, 3>().setIdentity();
  motion.map_.bottomRightCorner<3, 3>() = axes * axes.transpose();
  motion.dofs_ = 3 * count;
  motion.p_ = p;
  motion.axes_ = axes;
  motion.rank_ = static_cast<int>(axes.cols());
  return motion;
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
