// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "limber/common/types.hpp"

/// Rules of degree 5 with positive weights, which sum to 1.
namespace limber::contact {

template <int corners>
struct QuadraturePoint {
  std::array<double, corners> share;  ///< of each corner [-]
  double weight = 0.0;                ///< [-]

  [[nodiscard]] Vector3 find_place(
      const std::array<Vector3, corners>& corner) const {
    Vector3 x = Vector3::Zero();
    for (int i = 0; i < corners; ++i) {
      x += share[static_cast<std::size_t>(i)] *
           corner[static_cast<std::size_t>(i)];
    }
    return x;
  }
};

/// On a tetrahedron.
/// Source     [@walkington2000]
[[nodiscard]] const std::array<QuadraturePoint<4>, 14>& tetrahedron_rule();

/// On a triangle.
/// Source     [@radon1948]
[[nodiscard]] const std::array<QuadraturePoint<3>, 7>& triangle_rule();

}  // namespace limber::contact
