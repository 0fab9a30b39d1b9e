// SPDX-License-Identifier: BSD-3-Clause
#include "support/heavy_top.hpp"

#include <cmath>

#include "support/free_top.hpp"

namespace limber::testing {

HeavyTop::HeavyTop(double I1, double I3, double torque, double spin,
                   double tilt)
    : a_(I3 * spin / I1), high_(std::cos(tilt)) {
  const double beta = 2.0 * torque / I1;
  // What (u2 - u) leaves of the cubic: u^2 - p u + p u2 - 1 = 0.
  const double p = a_ * a_ / beta;
  const double root = std::sqrt(p * p - 4.0 * (p * high_ - 1.0));
  low_ = 0.5 * (p - root);
  const double beyond = 0.5 * (p + root);
  rate_ = 0.5 * std::sqrt(beta * (beyond - low_));
  kc_ = std::sqrt((beyond - high_) / (beyond - low_));
}

double HeavyTop::nutation_period() const {
  return 2.0 * complete_integral(kc_) / rate_;
}

double HeavyTop::cosine(double t) const {
  const double quarter = complete_integral(kc_);
  const double u = std::remainder(rate_ * t + quarter, 4.0 * quarter);
  const double sn = jacobi(u, kc_).sn;
  return low_ + (high_ - low_) * sn * sn;
}

double HeavyTop::precession() const {
  constexpr int kPoints = 256;
  double sum = 0.0;
  for (int i = 0; i < kPoints; ++i) {
    const double u = cosine(nutation_period() * i / kPoints);
    sum += a_ * (high_ - u) / (1.0 - u * u);
  }
  return sum * nutation_period() / kPoints;
}

}  // namespace limber::testing
