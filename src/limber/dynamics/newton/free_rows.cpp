// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/newton/free_rows.hpp"

#include <Eigen/QR>
#include <limits>

namespace limber::dynamics {
namespace {

// Relative to a block's largest row: smaller rows are round-off of the
// stiffness.
constexpr double kFree = 64.0 * std::numeric_limits<double>::epsilon();

// Q of a QR decomposition, reflection by reflection: householderQ() would
// compile a blocked product, for seconds, that small matrices never use.
Matrix3 multiply_reflections(const Eigen::Matrix<double, 3, 6>& qr,
                             const Vector3& scale) {
  Matrix3 Q = Matrix3::Identity();
  for (int k = 0; k < 3; ++k) {
    Vector3 v = Vector3::Unit(k);
    for (int i = k + 1; i < 3; ++i) v[i] = qr(i, k);
    Q -= scale[k] * (Q * v) * v.transpose();
  }
  return Q;
}

}  // namespace

Matrix6 separate_free_rows(Matrix6& K) {
  Matrix6 rotation = Matrix6::Zero();
  for (const int first : {0, 3}) {
    const Eigen::Matrix<double, 3, 6> rows = K.middleRows<3>(first);
    const Eigen::ColPivHouseholderQR<Eigen::Matrix<double, 3, 6>> qr(rows);
    const Matrix3 Q = multiply_reflections(qr.matrixQR(), qr.hCoeffs());
    rotation.block<3, 3>(first, first) = Q.transpose();
    K.middleRows<3>(first) = Q.transpose() * rows;
    const double noise = kFree * rows.cwiseAbs().maxCoeff();
    for (int i = first; i < first + 3; ++i) {
      if (K.row(i).cwiseAbs().maxCoeff() <= noise) K.row(i).setZero();
    }
  }
  return rotation;
}

}  // namespace limber::dynamics
