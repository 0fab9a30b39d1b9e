// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/elasticity/diagonal_stiffness.hpp"

#include <utility>

#include "limber/flexbody/elasticity/elasticity_checks.hpp"

namespace limber::flexbody {

DiagonalStiffness::DiagonalStiffness(Parameters parameters)
    : parameters_(std::move(parameters)) {
  check_eigenvalues(parameters_.lambda);
}

double DiagonalStiffness::energy(const ModesIn& q) const {
  return 0.5 * (parameters_.lambda.array() * q.array().square()).sum();
}

void DiagonalStiffness::calc_force(const ModesIn& q, ModesOut force) const {
  force.array() = parameters_.lambda.array() * q.array();
}

void DiagonalStiffness::calc_tangent(const ModesIn& /*q*/,
                                     ModesSquare tangent) const {
  tangent.setZero();
  tangent.diagonal() = parameters_.lambda;
}

void DiagonalStiffness::calc_force_over_step(const ModesIn& q0,
                                             const ModesIn& q1,
                                             ModesOut force) const {
  force.array() = parameters_.lambda.array() * (0.5 * (q0 + q1)).array();
}

void DiagonalStiffness::calc_tangent_over_step(const ModesIn& q0,
                                               const ModesIn& /*q1*/,
                                               ModesSquare tangent) const {
  calc_tangent(q0, tangent);
}

double DiagonalStiffness::lowest_rest_stiffness() const {
  return parameters_.lambda.minCoeff();
}

}  // namespace limber::flexbody
