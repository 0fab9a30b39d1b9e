// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/slices/roll_off.hpp"

#include <algorithm>
#include <cmath>

namespace limber::flexbody {
namespace {

// The number of modes that matter, and the highest frequency among them.
struct Band {
  int count = 0;
  double highest = 0.0;  // omega_N [rad/s]
};

Band find_band(const VectorX& flexibility, const VectorX& lambda) {
  constexpr double kLeastFraction = 1e-4;
  Band band;
  for (Eigen::Index k = 0; k < lambda.size(); ++k) {
    if (flexibility[k] <= kLeastFraction * flexibility.sum()) continue;
    ++band.count;
    band.highest = std::max(band.highest, std::sqrt(lambda[k]));
  }
  return band;
}

}  // namespace

VectorX find_roll_off(const VectorX& flexibility, const VectorX& lambda) {
  VectorX squares = VectorX::Ones(lambda.size());
  const Band band = find_band(flexibility, lambda);
  if (band.count == 0) return squares;
  const double end = band.highest * (band.count + 0.5) / band.count;
  for (Eigen::Index k = 0; k < lambda.size(); ++k) {
    const double u = std::min(std::sqrt(lambda[k]) / end, 1.0);
    squares[k] = 1.0 - u * u * u * u;
  }
  return squares;
}

}  // namespace limber::flexbody
