// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/model/force_directions.hpp"

#include <algorithm>
#include <cmath>

#include "limber/common/errors.hpp"

namespace limber::flexbody {

ForceDirections find_force_directions(const MatrixX& F, double tolerance,
                                      Eigen::Index most) {
  LIMBER_EXPECT(tolerance > 1e-7);
  VectorX left = F.colwise().squaredNorm().transpose();
  const double longest = left.size() > 0 ? left.maxCoeff() : 0.0;
  const double enough = tolerance * tolerance * longest;
  const Eigen::Index limit = std::min({most, F.rows(), F.cols()});
  ForceDirections found{MatrixX(F.rows(), limit), MatrixX(limit, F.cols())};
  Eigen::Index r = 0;
  for (; r < limit; ++r) {
    Eigen::Index pivot = 0;
    if (left.maxCoeff(&pivot) <= enough) break;
    VectorX q = F.col(pivot);
    for (int pass = 0; pass < 2; ++pass)
      q -= found.Q.leftCols(r) * (found.Q.leftCols(r).transpose() * q);
    found.Q.col(r) = q.normalized();
    found.R.row(r) = found.Q.col(r).transpose() * F;
    left -= found.R.row(r).cwiseAbs2().transpose();
    left[pivot] = 0.0;  // its remainder is roundoff
  }
  found.is_whole = left.size() == 0 || left.maxCoeff() <= enough;
  found.Q.conservativeResize(Eigen::NoChange, r);
  found.R.conservativeResize(r, Eigen::NoChange);
  return found;
}

}  // namespace limber::flexbody
