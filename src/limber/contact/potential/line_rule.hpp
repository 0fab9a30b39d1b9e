// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

namespace limber::contact {

/// Gauss-Legendre rule on (0, 1), exact for polynomials of degree 2 count - 1.
template <std::size_t count>
struct LineRule {
  std::array<double, count> places;   ///< [-]
  std::array<double, count> weights;  ///< sum 1 [-]

  LineRule();
};

/// @tparam count 3, 6, 8 or 12
template <std::size_t count>
[[nodiscard]] const LineRule<count>& line_rule() {
  static const LineRule<count> rule;
  return rule;
}

extern template struct LineRule<3>;
extern template struct LineRule<6>;
extern template struct LineRule<8>;
extern template struct LineRule<12>;

}  // namespace limber::contact
