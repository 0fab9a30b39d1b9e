// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/types.hpp"
#include "limber/view/recording.hpp"

namespace limber::view {

/// Where a page or a scene counts from, so that single precision holds the
/// motion wherever it is.
///
/// Equation   p_WP(i) = offset + path(i) + what is stored
struct Home {
  Vector3 offset;  ///< zero but for scenes far from the origin [m]
  /// T x 3: motion that all bodies have in common, the mean of their places
  /// less the offset; zero unless it is 1000 times the size of the scene [m].
  MatrixX path;
  bool travels = false;  ///< whether the path is not zero
};

[[nodiscard]] Home find_home(const Recording& recording);

}  // namespace limber::view
