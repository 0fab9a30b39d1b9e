// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/body_factor.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/errors.hpp"
#include "common/rotation.hpp"

namespace limber::dynamics {

BodyFactor::BodyFactor(int modes)
    : coupling_(Matrix3X::Zero(3, modes)),
      back_coupling_(Matrix3X::Zero(3, modes)),
      inverse_modes_(VectorX::Zero(modes)) {}

void BodyFactor::update(const BodyModel& body, const BodyTerms& terms,
                        const Vector3& w, const Matrix3& T,
                        const Coefficients& c) {
  inverse_modes_.array() =
      (c.acceleration + c.velocity * body.damping.array() + body.lambda.array())
          .inverse();
  if (!body.has_rigid_motion()) return;  // its rigid blocks stay zero
  inverse_mass_ = 1.0 / (c.acceleration * body.mass);
  // The step's own rotation changes by T times the increments, which are of
  // the end.
  const Matrix3 gyroscopic = skew(w) * terms.J - skew(terms.J * w);
  rotation_ = (c.acceleration * terms.J + c.velocity * gyroscopic) * T;
  Matrix3 schur = rotation_;
  for (int k = 0; k < body.modes; ++k) {
    const Vector3 column = c.acceleration * terms.H.col(k);
    const Vector3 row = T.transpose() * column;
    coupling_.col(k) = column;
    back_coupling_.col(k) = row;
    schur -= inverse_modes_[k] * column * row.transpose();
  }
  inverse_rotation_ = schur.inverse();
  if (!inverse_rotation_.allFinite()) {
    throw NumericalError(
        fmt::format("body '{}': its inertia has become singular", body.name));
  }
}

void BodyFactor::solve(double* x) const {
  Eigen::Map<Vector3> translation(x);
  Eigen::Map<Vector3> rotation(x + 3);
  double* modes = x + 6;
  translation *= inverse_mass_;
  Vector3 right = rotation;
  for (Eigen::Index k = 0; k < inverse_modes_.size(); ++k) {
    modes[k] *= inverse_modes_[k];
    right -= coupling_.col(k) * modes[k];
  }
  rotation = inverse_rotation_ * right;
  const Vector3 turned = rotation;
  for (Eigen::Index k = 0; k < inverse_modes_.size(); ++k) {
    modes[k] -= inverse_modes_[k] * back_coupling_.col(k).dot(turned);
  }
}

// A row of G at a time, through D's arrow shape.
void BodyFactor::solve_rows(const Matrix6X& G, Matrix6X& result) const {
  result.leftCols<3>() = inverse_mass_ * G.leftCols<3>();
  Eigen::Matrix<double, 6, 3> right = G.middleCols<3>(3);
  for (Eigen::Index k = 0; k < inverse_modes_.size(); ++k) {
    result.col(6 + k) = inverse_modes_[k] * G.col(6 + k);
    right.noalias() -= result.col(6 + k) * coupling_.col(k).transpose();
  }
  const Eigen::Matrix<double, 6, 3> turned =
      right * inverse_rotation_.transpose();
  result.middleCols<3>(3) = turned;
  for (Eigen::Index k = 0; k < inverse_modes_.size(); ++k) {
    result.col(6 + k) -= inverse_modes_[k] * (turned * back_coupling_.col(k));
  }
}

Matrix6 BodyFactor::block(int row, int column) const {
  const Eigen::Index modes = inverse_modes_.size();
  const auto first_mode = [](int i) { return Eigen::Index{6} * i - 6; };
  const auto count = [&](int i) {
    return std::min<Eigen::Index>(6, modes - first_mode(i));
  };
  Matrix6 D = Matrix6::Zero();
  if (row == column) {
    D.setIdentity();
    if (row > 0) {
      D.diagonal().head(count(row)) =
          inverse_modes_.segment(first_mode(row), count(row)).cwiseInverse();
    } else if (inverse_mass_ > 0.0) {
      D.topLeftCorner<3, 3>() /= inverse_mass_;
      D.bottomRightCorner<3, 3>() = rotation_;
    }
  } else if (row == 0) {
    D.block(3, 0, 3, count(column)) =
        coupling_.middleCols(first_mode(column), count(column));
  } else if (column == 0) {
    D.block(0, 3, count(row), 3) =
        back_coupling_.middleCols(first_mode(row), count(row)).transpose();
  }
  return D;
}

}  // namespace limber::dynamics
