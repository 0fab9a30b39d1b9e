// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <concepts>
#include <limits>

namespace limber {

/// Whether `x`, truncated, is representable as `Integer`. The cast of any other
/// value is undefined behaviour in C++.
template <std::integral Integer>
[[nodiscard]] bool fits(double x) {
  const double limit = std::ldexp(1.0, std::numeric_limits<Integer>::digits);
  const double lowest = std::is_signed_v<Integer> ? -limit : 0.0;
  return x > lowest - 1.0 && x < limit;
}

/// Whether `x` is an integer that `Integer` can represent.
template <std::integral Integer>
[[nodiscard]] bool is_whole(double x) {
  return fits<Integer>(x) && x == std::trunc(x);
}

}  // namespace limber
