// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/patches/nodal_motion.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <utility>

#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/rotation.hpp"

namespace limber::contact {

struct NodalMotion::Fit {
  Vector6 motion = Vector6::Zero();         // M e
  Matrix6 by_motion = Matrix6::Identity();  // 1 + N
};

NodalMotion::NodalMotion(flexbody::NodalPiece piece)
    : piece_(std::move(piece)), size_(piece_.x_P.colwise().norm().maxCoeff()) {}

Eigen::Index NodalMotion::least_coordinates() const {
  return 3 * (Eigen::Index{*std::ranges::max_element(piece_.nodes)} + 1);
}

NodalMotion::Fit NodalMotion::fit(const Pose& X, const double* u) const {
  Fit fit;
  for (Eigen::Index i = 0; i < piece_.x_P.cols(); ++i) {
    const Vector3 from = piece_.x_P.col(i);
    const Eigen::Map<const Vector3> moved(
        u + 3 * piece_.nodes[static_cast<std::size_t>(i)]);
    const Vector3 e = X.R.transpose() * (from + moved - X.p) - from;
    const auto fraction = piece_.motion.middleCols<3>(3 * i);
    fit.motion += fraction * e;
    fit.by_motion.rightCols<3>() -= fraction * skew(e);
  }
  return fit;
}

// The rotation nearest to that of the nodes, of equal weights, with their mean.
Pose NodalMotion::begin(const double* u) const {
  const auto count = static_cast<double>(piece_.x_P.cols());
  const Vector3 mean = piece_.x_P.rowwise().sum() / count;
  Vector3 now = mean;
  for (const int n : piece_.nodes) {
    now += Eigen::Map<const Vector3>(u + 3 * n) / count;
  }
  Matrix3 S = Matrix3::Zero();  // sum X x'
  for (Eigen::Index i = 0; i < piece_.x_P.cols(); ++i) {
    const Vector3 from = piece_.x_P.col(i);
    const Eigen::Map<const Vector3> moved(
        u + 3 * piece_.nodes[static_cast<std::size_t>(i)]);
    S += (from - mean) * (from + moved - now).transpose();
  }
  const Vector3 skewed(S(1, 2) - S(2, 1), S(2, 0) - S(0, 2), S(0, 1) - S(1, 0));
  MatrixX N(4, 4);
  N << S.trace(), skewed.transpose(), skewed,
      S + S.transpose() - S.trace() * Matrix3::Identity();
  const VectorX q = dense::find_eigenpairs(N).vectors.col(3);
  const Matrix3 R =
      Quaternion(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
  return {R, now - R * mean};
}

// Newton's method: quadratic.
NodalMotion::State NodalMotion::find_state(const double* u) const {
  constexpr int kMost = 50;
  constexpr double kDone = 1e-9;  // the next step is of its square
  Pose X = begin(u);
  for (int i = 0; i < kMost; ++i) {
    const Fit now = fit(X, u);
    const Matrix6 inverse = now.by_motion.inverse();
    const Vector6 step = inverse * now.motion;
    const double length = step.head<3>().norm() + size_ * step.tail<3>().norm();
    X.p += X.R * step.head<3>();
    X.R = X.R * exp_rotation(step.tail<3>());
    if (length <= kDone * size_) return {X, inverse};
  }
  throw NumericalError(
      "contact: a piece of the surface of a body at level full is deformed so "
      "far that it has no pose");
}

Vector6 NodalMotion::find_rate(const State& state, const double* udot) const {
  Vector6 rate = Vector6::Zero();
  for (Eigen::Index i = 0; i < piece_.x_P.cols(); ++i) {
    const Eigen::Map<const Vector3> v(
        udot + 3 * piece_.nodes[static_cast<std::size_t>(i)]);
    rate += piece_.motion.middleCols<3>(3 * i) * (state.X.R.transpose() * v);
  }
  return state.by_fit * rate;
}

void NodalMotion::set_rows(const State& state, const Vector3& x_P,
                           Matrix3X& out) const {
  Eigen::Matrix<double, 3, 6> at;
  at << Matrix3::Identity(), -skew(x_P);
  const Eigen::Matrix<double, 3, 6> by_fit = state.X.R * at * state.by_fit;
  out.setZero();
  for (Eigen::Index i = 0; i < piece_.x_P.cols(); ++i) {
    out.middleCols<3>(3 * piece_.nodes[static_cast<std::size_t>(i)]) =
        by_fit * piece_.motion.middleCols<3>(3 * i) * state.X.R.transpose();
  }
}

}  // namespace limber::contact
