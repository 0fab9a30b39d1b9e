// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/newton/free_rows.hpp"

#include <Eigen/QR>
#include <cmath>
#include <limits>

namespace limber::dynamics {
namespace {

using ThreeRows = Eigen::Matrix<double, 3, 6>;

// Relative to a block's largest entry: smaller rows are round-off of the
// stiffness.
constexpr double kFree = 64.0 * std::numeric_limits<double>::epsilon();
// Sum of a row's entries over its own: below it rows scaled to their size are
// far from dependent.
constexpr double kDominated = 1.5;

// Q of a QR decomposition, reflection by reflection: householderQ() would
// compile a blocked product, for seconds, that small matrices never use.
Matrix3 multiply_reflections(const ThreeRows& qr, const Vector3& scale) {
  Matrix3 Q = Matrix3::Identity();
  for (int k = 0; k < 3; ++k) {
    Vector3 v = Vector3::Unit(k);
    for (int i = k + 1; i < 3; ++i) v[i] = qr(i, k);
    Q -= scale[k] * (Q * v) * v.transpose();
  }
  return Q;
}

// Whether each row is free or that of its own direction, as where the axes of
// a joint are those of F. False for NaN.
bool are_separate(const ThreeRows& rows, int first, double noise) {
  for (int i = 0; i < 3; ++i) {
    const double all = rows.row(i).cwiseAbs().sum();
    const double own = std::abs(rows(i, first + i));
    if (!(all <= noise) && !(all <= kDominated * own)) return false;
  }
  return true;
}

}  // namespace

Matrix6 separate_free_rows(Matrix6& K) {
  Matrix6 rotation = Matrix6::Identity();
  for (const int first : {0, 3}) {
    const ThreeRows rows = K.middleRows<3>(first);
    const double noise = kFree * rows.cwiseAbs().maxCoeff();
    if (!are_separate(rows, first, noise)) {
      const Eigen::ColPivHouseholderQR<ThreeRows> qr(rows);
      const Matrix3 Q = multiply_reflections(qr.matrixQR(), qr.hCoeffs());
      rotation.block<3, 3>(first, first) = Q.transpose();
      K.middleRows<3>(first) = Q.transpose() * rows;
    }
    for (int i = first; i < first + 3; ++i) {
      if (K.row(i).cwiseAbs().maxCoeff() <= noise) K.row(i).setZero();
    }
  }
  return rotation;
}

}  // namespace limber::dynamics
