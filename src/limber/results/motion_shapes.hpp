// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>

#include "limber/common/types.hpp"

namespace limber::results {

/// Displacements, or another field, over time as a few shapes times
/// coordinates.
struct MotionShapes {
  MatrixX shapes;       ///< rows of the field x r, orthonormal [kg^-1/2,
                        ///< formally; of another field 1]
  MatrixX coordinates;  ///< T x r [kg^1/2 m; the other field's unit]
  double error = 0.0;   ///< largest size of the omitted part [m; its unit]
};

/// Length of the longest vector in three rows a node [as u].
[[nodiscard]] double find_largest_length(const VectorX& u);

/// Truncated singular-value decomposition of the columns `column(i)` at `count`
/// times.
///
/// Equation   u(t_i) = sum_k shapes_k coordinates_ik + rest; shapes until the
///            rest is below kShapeTolerance of the largest displacement, at
///            most kMostShapes
/// Source     method of snapshots (Sirovich 1987); shapes from at most
///            kMostSnapshots evenly spaced times, coordinates at all of them
/// Limits     squares of singular values: shapes below 1e-7 of the largest are
///            lost in round-off
/// @param size norm of the omitted part of a column; by default the largest
/// displacement of a node, three rows each
[[nodiscard]] MotionShapes find_motion_shapes(
    const std::function<VectorX(std::size_t)>& column, std::size_t count,
    const std::function<double(const VectorX&)>& size = find_largest_length);

inline constexpr double kShapeTolerance = 1e-5;  ///< of the largest [-]
inline constexpr int kMostShapes = 32;
inline constexpr std::size_t kMostSnapshots = 256;

}  // namespace limber::results
