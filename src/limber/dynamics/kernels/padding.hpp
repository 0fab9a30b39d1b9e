// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace limber::dynamics::kernels {

/// Doubles that kernels compute side by side.
constexpr std::size_t kLanes = 4;

/// `count` rounded up to a multiple of them.
constexpr std::size_t pad(std::size_t count) {
  return (count + kLanes - 1) / kLanes * kLanes;
}

}  // namespace limber::dynamics::kernels
