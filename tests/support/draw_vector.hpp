// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/types.hpp"

namespace limber::testing {

/// Three draws as a vector, z first. Vector3(draw(), draw(), draw()) is another
/// one with another compiler: the order of arguments is not in the language.
template <typename Draw>
[[nodiscard]] Vector3 draw_vector(Draw&& draw) {
  const double z = draw();
  const double y = draw();
  const double x = draw();
  return {x, y, z};
}

}  // namespace limber::testing
