// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/analysis/small_motion.hpp"

namespace limber::dynamics {

MatrixX SmallMotion::project_relaxations(const MatrixX& Q) const {
  MatrixX rows(relaxation_rates().size(), Q.cols());
  Eigen::Index row = 0;
  for (const Relaxation& r : relaxations) {
    const Eigen::Index m = r.weights.size();
    rows.middleRows(row, m) = r.weights.asDiagonal() * Q.middleRows(r.first, m);
    row += m;
  }
  return rows;
}

VectorX SmallMotion::relaxation_rates() const {
  std::vector<double> rates;
  for (const Relaxation& r : relaxations) {
    rates.insert(rates.end(), static_cast<std::size_t>(r.weights.size()),
                 1.0 / r.time);
  }
  return Eigen::Map<const VectorX>(rates.data(), std::ssize(rates));
}

}  // namespace limber::dynamics
