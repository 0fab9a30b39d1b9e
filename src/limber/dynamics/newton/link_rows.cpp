// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/newton/link_rows.hpp"

#include "limber/common/index.hpp"
#include "limber/dynamics/newton/free_rows.hpp"

namespace limber::dynamics {

void reflect_rows(const Vector3& p, Matrix6X& rows) {
  for (Eigen::Index k = 0; k < rows.cols(); ++k) {
    const Vector3 rotation = rows.col(k).tail<3>();
    rows.col(k).head<3>() = p.cross(rotation) - rows.col(k).head<3>();
    rows.col(k).tail<3>() = -rotation;
  }
}

void contract_rows(const Vector6& gradient, Matrix6X& rows) {
  for (Eigen::Index k = 0; k < rows.cols(); ++k) {
    const double along = gradient.dot(rows.col(k));
    rows.col(k).setZero();
    rows(0, k) = along;
  }
}

const joints::ConstraintGap* find_constraint(const SystemTerms& terms,
                                             std::size_t link) {
  if (link >= terms.couplers.size() || terms.couplers[link].ideal < 0) {
    return nullptr;
  }
  return &terms.constraints[index(terms.couplers[link].ideal)];
}

LinkRows find_link_rows(const SystemTerms& terms, std::size_t link,
                        double velocity) {
  Matrix6 K = find_link_stiffness(terms, link, velocity);
  const joints::ConstraintGap* constraint = find_constraint(terms, link);
  if (constraint == nullptr) {
    const Matrix6 rotation = separate_free_rows(K);
    return {rotation, Vector6::Ones(), K};
  }
  Matrix6 held = constraint->directions;
  const Matrix6 rotation = separate_free_rows(held);
  LinkRows rows{rotation, Vector6::Ones(), rotation * K};
  for (int i = 0; i < 6; ++i) {
    if (held.row(i).norm() < 0.5) continue;
    rows.yields[i] = 0.0;
    rows.stiffness.row(i) = held.row(i);
  }
  return rows;
}

// Twice, so that what is removed leaves no round-off relative to it.
Vector6 remove_constrained(const joints::ConstraintGap& constraint,
                           const Vector6& wrench) {
  const Vector6 rest = wrench - constraint.directions * wrench;
  return rest - constraint.directions * rest;
}

Matrix6 find_link_stiffness(const SystemTerms& terms, std::size_t link,
                            double velocity) {
  if (link < terms.couplers.size()) {
    const joints::CouplerResponse& r = terms.couplers[link].response;
    return r.stiffness + velocity * r.damping;
  }
  const joints::ScalarResponse& r =
      terms.transmissions[link - terms.couplers.size()].response;
  Matrix6 K = Matrix6::Zero();
  K(0, 0) = r.stiffness + velocity * r.damping;
  return K;
}

}  // namespace limber::dynamics
