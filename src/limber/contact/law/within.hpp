// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/types.hpp"

namespace limber::contact {

/// A vector within a ball of radius `most`, as return mapping leaves it, and
/// its derivatives by the vector and by the radius.
template <int kSize>
struct Within {
  using Vector = Eigen::Matrix<double, kSize, 1>;
  using Matrix = Eigen::Matrix<double, kSize, kSize>;

  Within(const Vector& x, double most) : value(x) {
    const double size = x.norm();
    if (!(size > most)) return;
    is_cut = true;
    by_most = x / size;
    value = most * by_most;
    by_value =
        most / size * (Matrix::Identity() - by_most * by_most.transpose());
  }

  Vector value;
  Matrix by_value = Matrix::Identity();
  Vector by_most = Vector::Zero();
  bool is_cut = false;
};

}  // namespace limber::contact
