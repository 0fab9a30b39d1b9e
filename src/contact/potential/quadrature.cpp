// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/potential/quadrature.hpp"

#include <cmath>
#include <cstddef>

namespace limber::contact {
namespace {

std::array<QuadraturePoint<4>, 14> make_tetrahedron_rule() {
  std::array<QuadraturePoint<4>, 14> rule;
  std::size_t k = 0;
  const auto add_vertices = [&](double a, double weight) {
    for (std::size_t i = 0; i < 4; ++i) {
      rule[k] = {{a, a, a, a}, weight};
      rule[k++].share[i] = 1.0 - 3.0 * a;
    }
  };
  add_vertices(0.31088591926330060980, 0.11268792571801585080);
  add_vertices(0.092735250310891226402, 0.073493043116361949544);
  constexpr double kEdge = 0.045503704125649649492;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) {
      const double rest = 0.5 - kEdge;
      rule[k] = {{rest, rest, rest, rest}, 0.042546020777081466438};
      rule[k].share[i] = rule[k].share[j] = kEdge;
      ++k;
    }
  }
  return rule;
}

// Abscissae (6 -+ sqrt(15)) / 21 and weights (155 -+ sqrt(15)) / 1200.
std::array<QuadraturePoint<3>, 7> make_triangle_rule() {
  std::array<QuadraturePoint<3>, 7> rule;
  const double third = 1.0 / 3.0;
  rule[0] = {{third, third, third}, 0.225};
  std::size_t k = 1;
  for (const double root : {std::sqrt(15.0), -std::sqrt(15.0)}) {
    const double a = (6.0 + root) / 21.0;
    for (std::size_t i = 0; i < 3; ++i) {
      rule[k] = {{a, a, a}, (155.0 + root) / 1200.0};
      rule[k++].share[i] = 1.0 - 2.0 * a;
    }
  }
  return rule;
}

}  // namespace

const std::array<QuadraturePoint<4>, 14>& tetrahedron_rule() {
  static const auto rule = make_tetrahedron_rule();
  return rule;
}

const std::array<QuadraturePoint<3>, 7>& triangle_rule() {
  static const auto rule = make_triangle_rule();
  return rule;
}

}  // namespace limber::contact
