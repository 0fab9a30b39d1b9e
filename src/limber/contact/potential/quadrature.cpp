// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/potential/quadrature.hpp"

#include <cmath>
#include <cstddef>

namespace limber::contact {
namespace {

// Abscissae (6 -+ sqrt(15)) / 21 and weights (155 -+ sqrt(15)) / 1200.
std::array<TrianglePoint, 7> make_triangle_rule() {
  std::array<TrianglePoint, 7> rule;
  const double third = 1.0 / 3.0;
  rule[0] = {{third, third, third}, 0.225};
  std::size_t k = 1;
  for (const double root : {std::sqrt(15.0), -std::sqrt(15.0)}) {
    const double a = (6.0 + root) / 21.0;
    for (std::size_t i = 0; i < 3; ++i) {
      rule[k] = {{a, a, a}, (155.0 + root) / 1200.0};
      rule[k++].fraction[i] = 1.0 - 2.0 * a;
    }
  }
  return rule;
}

}  // namespace

const std::array<TrianglePoint, 7>& triangle_rule() {
  static const auto rule = make_triangle_rule();
  return rule;
}

}  // namespace limber::contact
