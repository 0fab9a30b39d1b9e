// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace limber {

/// An index into a std::vector. @param i >= 0
[[nodiscard]] constexpr std::size_t index(int i) {
  return static_cast<std::size_t>(i);
}

}  // namespace limber
