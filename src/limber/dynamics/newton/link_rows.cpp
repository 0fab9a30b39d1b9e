// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/newton/link_rows.hpp"

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
