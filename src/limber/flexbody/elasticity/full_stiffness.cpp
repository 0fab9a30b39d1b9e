// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/elasticity/full_stiffness.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/common/errors.hpp"
#include "limber/flexbody/elasticity/elasticity_checks.hpp"

namespace limber::flexbody {
namespace {

constexpr double kRoundoff = 1e-10;  // of the largest entry or eigenvalue

}  // namespace

FullStiffness::FullStiffness(Parameters parameters)
    : parameters_(std::move(parameters)) {
  MatrixX& K = parameters_.K;
  if (K.rows() == 0) throw InputError("the stiffness matrix has no rows");
  check_shape("the stiffness matrix", K, K.rows(), K.rows());
  check_finite("the stiffness matrix", K);
  if ((K - K.transpose()).cwiseAbs().maxCoeff() >
      kRoundoff * K.cwiseAbs().maxCoeff()) {
    throw InputError("the stiffness matrix is not symmetric");
  }
  K = (0.5 * (K + K.transpose())).eval();
  const VectorX values = dense::find_eigenvalues(K);
  if (!(values.minCoeff() >= -kRoundoff * values.cwiseAbs().maxCoeff())) {
    throw InputError(fmt::format(
        "the stiffness matrix has the eigenvalue {:g} rad^2/s^2; expected all "
        ">= 0",
        values.minCoeff()));
  }
  lowest_ = std::max(values.minCoeff(), 0.0);
  diagonal_ = K.diagonal();
}

double FullStiffness::energy(const ModesIn& q) const {
  double sum = 0.0;
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    sum += q[k] * parameters_.K.col(k).dot(q);
  }
  return 0.5 * sum;
}

void FullStiffness::calc_force(const ModesIn& q, ModesOut force) const {
  force.noalias() = parameters_.K * q;
}

void FullStiffness::calc_tangent(const ModesIn& /*q*/,
                                 ModesSquare tangent) const {
  tangent = parameters_.K;
}

void FullStiffness::calc_force_over_step(const ModesIn& q0, const ModesIn& q1,
                                         ModesOut force) const {
  for (Eigen::Index k = 0; k < q0.size(); ++k) {
    force[k] = 0.5 * parameters_.K.col(k).dot(q0 + q1);
  }
}

void FullStiffness::calc_tangent_over_step(const ModesIn& q0,
                                           const ModesIn& /*q1*/,
                                           ModesSquare tangent) const {
  calc_tangent(q0, tangent);
}

}  // namespace limber::flexbody
