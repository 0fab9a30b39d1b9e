// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/terms/maxwell.hpp"

#include "limber/dynamics/system/unknowns.hpp"

namespace limber::dynamics {
namespace {

// sum_k lambda_k d_kj^2 of an element j.
double sum_squares(const BodyModel& body, const VectorX& all, Eigen::Index j) {
  return (flexbody::rest_stiffness(body.elasticity).array() *
          maxwell_of(body, all).col(j).array().square())
      .sum();
}

}  // namespace

void add_maxwell_force(const BodyModel& body, const VectorX& all,
                       Eigen::Ref<VectorX> force) {
  for (Eigen::Index j = 0; j < body.maxwell.size(); ++j) {
    force.array() += body.maxwell.strengths[j] *
                     flexbody::rest_stiffness(body.elasticity).array() *
                     maxwell_of(body, all).col(j).array();
  }
}

double find_maxwell_energy(const BodyModel& body, const VectorX& all) {
  double sum = 0.0;
  for (Eigen::Index j = 0; j < body.maxwell.size(); ++j) {
    sum += 0.5 * body.maxwell.strengths[j] * sum_squares(body, all, j);
  }
  return sum;
}

double find_maxwell_loss(const BodyModel& body, const VectorX& all) {
  double sum = 0.0;
  for (Eigen::Index j = 0; j < body.maxwell.size(); ++j) {
    sum += body.maxwell.strengths[j] / body.maxwell.times[j] *
           sum_squares(body, all, j);
  }
  return sum;
}

void stretch_maxwell(const SystemModel& model, const VectorX& change,
                     double fraction, VectorX& all) {
  for (const BodyModel& body : model.bodies) {
    for (Eigen::Index j = 0; j < body.maxwell.size(); ++j) {
      maxwell_of(body, all).col(j) += fraction * mode_rows(body, change);
    }
  }
}

}  // namespace limber::dynamics
