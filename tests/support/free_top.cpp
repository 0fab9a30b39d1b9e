// SPDX-License-Identifier: BSD-3-Clause
#include "support/free_top.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace limber::testing {

double complete_integral(double kc) {
  double a = 1.0;
  double b = kc;
  for (int i = 0; i < 40 && std::abs(a - b) > 1e-16 * a; ++i) {
    const double mean = 0.5 * (a + b);
    b = std::sqrt(a * b);
    a = mean;
  }
  return 0.5 * std::numbers::pi / a;
}

JacobiElliptic jacobi(double u, double kc) {
  constexpr int kLevels = 8;  // quadratic: kc = 1e-4 needs 6
  std::array<double, kLevels + 1> a{1.0};
  std::array<double, kLevels + 1> c{};
  double b = kc;
  for (std::size_t i = 1; i <= kLevels; ++i) {
    a[i] = 0.5 * (a[i - 1] + b);
    c[i] = 0.5 * (a[i - 1] - b);
    b = std::sqrt(a[i - 1] * b);
  }
  double phi = std::ldexp(a[kLevels] * u, kLevels);
  for (std::size_t i = kLevels; i > 0; --i) {
    phi = 0.5 * (phi + std::asin(c[i] / a[i] * std::sin(phi)));
  }
  const double sn = std::sin(phi);
  const double cn = std::cos(phi);
  return {sn, cn, std::sqrt(kc * kc + (1.0 - kc * kc) * cn * cn)};
}

FreeTop::FreeTop(double a) {
  const double E2 = I_[0] * a * a + I_[1];                  // 2 E
  const double L2 = I_[0] * I_[0] * a * a + I_[1] * I_[1];  // L^2
  amplitude_ = {std::sqrt((E2 * I_[2] - L2) / (I_[0] * (I_[2] - I_[0]))),
                std::sqrt((L2 - E2 * I_[0]) / (I_[1] * (I_[1] - I_[0]))),
                std::sqrt((L2 - E2 * I_[0]) / (I_[2] * (I_[2] - I_[0])))};
  const double scale = (I_[1] - I_[0]) * (E2 * I_[2] - L2);
  rate_ = std::sqrt(scale / I_.prod());
  // 2 E I_2 - L^2 = I_1 a^2 (I_2 - I_1), without cancellation.
  kc_ = std::sqrt((I_[2] - I_[0]) * I_[0] * a * a * (I_[1] - I_[0]) / scale);
  quarter_ = complete_integral(kc_);
}

Vector3 FreeTop::angular_velocity(double t) const {
  const double u = std::remainder(rate_ * t + quarter_, 4.0 * quarter_);
  const JacobiElliptic e = jacobi(u, kc_);
  return {amplitude_[0] * e.dn, amplitude_[1] * e.sn, amplitude_[2] * e.cn};
}

}  // namespace limber::testing
