// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/model/stress_modes.hpp"

#include <algorithm>
#include <cmath>

#include "limber/common/dense/symmetric_eigen.hpp"

namespace limber::flexbody {
namespace {

Matrix3 to_tensor(const Vector6& s) {
  Matrix3 tensor;
  tensor << s[0], s[3], s[5],  //
      s[3], s[1], s[4],        //
      s[5], s[4], s[2];
  return tensor;
}

}  // namespace

double calc_von_mises(const Vector6& s) {
  const double a = s[0] - s[1];
  const double b = s[1] - s[2];
  const double c = s[2] - s[0];
  return std::sqrt(0.5 * (a * a + b * b + c * c) +
                   3.0 * s.tail<3>().squaredNorm());
}

double calc_max_principal(const Vector6& stress) {
  return dense::find_eigenvalues(to_tensor(stress))[2];
}

Vector6 rotate_stress(const Vector6& stress_B, const Matrix3& R_BL) {
  const Matrix3 t = R_BL.transpose() * to_tensor(stress_B) * R_BL;
  Vector6 turned;
  turned << t(0, 0), t(1, 1), t(2, 2), t(0, 1), t(1, 2), t(0, 2);
  return turned;
}

double find_averaging_error(const StressModes& modes, const VectorX& lambda,
                            const VectorX& eta) {
  const double energy = eta.dot(lambda.cwiseProduct(eta));
  if (!(energy > 0.0)) return 0.0;
  return std::sqrt(std::max(0.0, eta.dot(modes.averaging * eta)) / energy);
}

}  // namespace limber::flexbody
