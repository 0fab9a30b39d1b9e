// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/elasticity/elasticity_checks.hpp"

#include <fmt/format.h>

#include <cmath>

#include "limber/common/errors.hpp"

namespace limber::flexbody {

void check_eigenvalues(const VectorX& lambda) {
  for (Eigen::Index k = 0; k < lambda.size(); ++k) {
    if (lambda[k] >= 0.0 && std::isfinite(lambda[k])) continue;
    throw InputError(fmt::format(
        "eigenvalue {} is {:g} rad^2/s^2; expected a finite number, not "
        "negative",
        k + 1, lambda[k]));
  }
}

void check_shape(const std::string& what, const MatrixX& table,
                 Eigen::Index rows, Eigen::Index columns) {
  if (table.rows() == rows && table.cols() == columns) return;
  throw InputError(fmt::format("{} is {} x {}; expected {} x {}", what,
                               table.rows(), table.cols(), rows, columns));
}

void check_finite(const std::string& what, const MatrixX& table) {
  for (Eigen::Index j = 0; j < table.cols(); ++j) {
    for (Eigen::Index i = 0; i < table.rows(); ++i) {
      if (std::isfinite(table(i, j))) continue;
      throw InputError(
          fmt::format("entry {}, {} of {} is {:g}; expected a finite number",
                      i + 1, j + 1, what, table(i, j)));
    }
  }
}

}  // namespace limber::flexbody
