// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/restitution.hpp"

#include <cmath>

#include "limber/common/errors.hpp"

namespace limber {

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

}  // namespace limber
