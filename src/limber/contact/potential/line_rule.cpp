// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/potential/line_rule.hpp"

#include <cmath>
#include <numbers>

namespace limber::contact {
namespace {

struct Legendre {
  double value;
  double slope;
};

Legendre find_legendre(std::size_t degree, double z) {
  double last = 1.0;
  double value = z;
  for (std::size_t k = 2; k <= degree; ++k) {
    const auto n = static_cast<double>(k);
    const double next = ((2.0 * n - 1.0) * z * value - (n - 1.0) * last) / n;
    last = value;
    value = next;
  }
  return {value,
          static_cast<double>(degree) * (z * value - last) / (z * z - 1.0)};
}

}  // namespace

template <std::size_t count>
LineRule<count>::LineRule() {
  constexpr int kIterations = 20;
  for (std::size_t i = 0; i < count; ++i) {
    double z = std::cos(std::numbers::pi * (static_cast<double>(i) + 0.75) /
                        (static_cast<double>(count) + 0.5));
    for (int k = 0; k < kIterations; ++k) {
      const Legendre at = find_legendre(count, z);
      z -= at.value / at.slope;
    }
    const double slope = find_legendre(count, z).slope;
    places[i] = 0.5 * (1.0 - z);
    weights[i] = 1.0 / ((1.0 - z * z) * slope * slope);
  }
}

template struct LineRule<3>;
template struct LineRule<6>;
template struct LineRule<8>;
template struct LineRule<12>;

}  // namespace limber::contact
