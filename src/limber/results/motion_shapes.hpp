// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>

#include "limber/common/types.hpp"

namespace limber::results {

/// A field at an output: displacements [m], or another in its own unit.
using FieldColumn = std::function<VectorX(std::size_t)>;

/// Length of the longest vector in three rows a node [as u].
[[nodiscard]] double find_largest_length(const VectorX& u);

/// Displacements, or another field, at `count` times as a few shapes times
/// coordinates: the shapes, rows of the field x r, orthonormal [kg^-1/2,
/// formally; of another field 1].
///
/// Equation   u(t_i) = sum_k shapes_k coordinates_ik + rest; shapes until the
///            rest is below kShapeTolerance of the largest displacement, at
///            most kMostShapes
/// Source     method of snapshots (Sirovich 1987), a truncated singular-value
///            decomposition; shapes from at most kMostSnapshots evenly spaced
///            times, coordinates at all of them
/// Limits     squares of singular values: shapes below 1e-7 of the largest are
///            lost in round-off
[[nodiscard]] MatrixX find_motion_shapes(const FieldColumn& column,
                                         std::size_t count);

/// Passes the coordinates at each time to `take`, r [kg^1/2 m; the other
/// field's unit].
/// @param size of the part of a column that the shapes leave out; by default
/// the largest displacement of a node, three rows each
/// @returns the largest size [m; its unit]
double find_coordinates(
    const MatrixX& shapes, const FieldColumn& column, std::size_t count,
    const std::function<void(const VectorX&)>& take,
    const std::function<double(const VectorX&)>& size = find_largest_length);

inline constexpr double kShapeTolerance = 1e-5;  ///< of the largest [-]
inline constexpr int kMostShapes = 32;
inline constexpr std::size_t kMostSnapshots = 256;

}  // namespace limber::results
