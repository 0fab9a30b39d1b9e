// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "limber/common/types.hpp"

namespace limber::contact {

struct TrianglePoint {
  std::array<double, 3> fraction;  ///< of each corner [-]
  double weight = 0.0;             ///< [-]

  [[nodiscard]] Vector3 find_place(const std::array<Vector3, 3>& corner) const {
    return fraction[0] * corner[0] + fraction[1] * corner[1] +
           fraction[2] * corner[2];
  }
};

/// A rule of degree 5 on a triangle, of positive weights, which sum to 1.
/// Source     [@radon1948]
[[nodiscard]] const std::array<TrianglePoint, 7>& triangle_rule();

}  // namespace limber::contact
