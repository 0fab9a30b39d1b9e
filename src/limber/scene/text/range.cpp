// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/text/range.hpp"

#include <fmt/format.h>

namespace limber::scene {

std::string Range::text() const {
  const double infinity = std::numeric_limits<double>::infinity();
  if (upper == infinity && lower == -infinity) return "a finite number";
  if (upper == infinity) {
    return fmt::format("a number {} {}", open_lower ? ">" : ">=", lower);
  }
  return fmt::format("a number in {}{}, {}{}", open_lower ? '(' : '[', lower,
                     upper, open_upper ? ')' : ']');
}

}  // namespace limber::scene
