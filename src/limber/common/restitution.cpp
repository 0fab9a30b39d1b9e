// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/restitution.hpp"

#include <algorithm>
#include <cmath>

#include "limber/common/errors.hpp"

namespace limber {
namespace {

// ln e of a beta by Simpson's rule, to 2e-9 for beta < 8: with
// u = u0 + (1 - u0) x^2, which resolves the pole near u0 of a large beta.
double find_log_restitution(double beta) {
  constexpr int kIntervals = 1000;
  const double start = beta > 1.0 ? -1.0 / beta : -1.0;
  const auto integrand = [&](double x) {
    const double u = start + (1.0 - start) * x * x;
    return 2.0 * (1.0 - start) * x * u * u / (1.0 + beta * (u - u * u * u));
  };
  double sum = 0.0;
  for (int i = 0; i <= kIntervals; ++i) {
    const bool is_end = i == 0 || i == kIntervals;
    const double weight = is_end ? 1.0 : 2.0 + 2.0 * (i % 2);
    sum += weight * integrand(static_cast<double>(i) / kIntervals);
  }
  return -beta * sum / (3.0 * kIntervals) - std::log(std::max(beta, 1.0));
}

}  // namespace

double find_restitution_damping(double restitution, double speed) {
  LIMBER_EXPECT(restitution > 0.0 && restitution <= 1.0);
  LIMBER_EXPECT(speed > 0.0 && std::isfinite(speed));
  const double e = restitution;
  if (e == 1.0) return 0.0;
  // Excess of the rebound's speed, for beta in (0, 1/e).
  const auto excess = [e](double beta) {
    return (1.0 + e) * beta - std::log1p(beta) + std::log1p(-e * beta);
  };
  double low = 0.0;
  double high = 1.0 / e;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (excess(middle) > 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high) / speed;
}

double find_restitution_factor(double restitution) {
  LIMBER_EXPECT(restitution >= 0.0 && restitution <= 1.0);
  if (restitution == 1.0) return 0.0;
  const double target = std::log(std::max(restitution, kLeastRestitution));
  double low = 0.0;
  double high = 8.0;
  for (int i = 0; i < 52; ++i) {
    const double middle = 0.5 * (low + high);
    (find_log_restitution(middle) > target ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace limber
