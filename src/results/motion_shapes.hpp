// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>

#include "limber/common/types.hpp"

namespace limber::results {

/// Displacements over time as a few shapes times coordinates.
struct MotionShapes {
  MatrixX shapes;       ///< 3n x r, orthonormal [kg^-1/2, formally]
  MatrixX coordinates;  ///< T x r [kg^1/2 m]
  double error = 0.0;   ///< largest displacement of a node left out [m]
};

/// Truncated singular-value decomposition of what `column(i)` gives at each of
/// `count` times.
///
/// Equation   u(t_i) = sum_k shapes_k coordinates_ik + rest; shapes until the
///            rest is below kShapeTolerance of the largest displacement, at
///            most kMostShapes
/// Source     method of snapshots (Sirovich 1987); shapes from at most
///            kMostSnapshots evenly spaced times, coordinates at all of them
/// Limits     squares of singular values: shapes below 1e-7 of the largest are
///            lost in round-off
[[nodiscard]] MotionShapes find_motion_shapes(
    const std::function<VectorX(std::size_t)>& column, std::size_t count);

inline constexpr double kShapeTolerance = 1e-5;  ///< of the largest [-]
inline constexpr int kMostShapes = 32;
inline constexpr std::size_t kMostSnapshots = 256;

}  // namespace limber::results
