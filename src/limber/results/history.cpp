// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/history.hpp"

#include <algorithm>

namespace limber::results {

std::vector<std::size_t> list_drawn_outputs(std::size_t count) {
  constexpr std::size_t kMost = 4000;
  const std::size_t stride = std::max<std::size_t>(1, count / kMost);
  std::vector<std::size_t> outputs;
  for (std::size_t i = 0; i < count; i += stride) outputs.push_back(i);
  if (count > 0 && outputs.back() + 1 != count) outputs.push_back(count - 1);
  return outputs;
}

}  // namespace limber::results
