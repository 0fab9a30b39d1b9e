// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "limber/common/records/manifest.hpp"
#include "limber/contact/shapes/shape.hpp"
#include "limber/joints/pairs/pair_interaction.hpp"
#include "limber/joints/pairs/touching.hpp"

namespace limber::contact {

/// Adds kind, sizes and pose of a shape; of a MeshSurface its nodes and tables.
void describe(Manifest& out, std::string_view name, const Shape& shape);

/// Largest radius of curvature for a contact of both: the larger of the shapes'
/// radii, of half of their shortest edges, or of a MeshSurface the largest
/// radius of its patches [m].
[[nodiscard]] double find_roundness(const Shape& A, const Shape& B);

/// The smaller of both shapes' roundnesses; a half space has none [m].
[[nodiscard]] double find_size(const Shape& A, const Shape& B);

/// For each mode the largest displacement of a node of the shape, m entries
/// [kg^-1/2].
[[nodiscard]] VectorX find_mode_reach(const Shape& shape);

/// @param mode_reach of find_mode_reach, here and below
[[nodiscard]] joints::TouchReach find_reach(const Shape& shape,
                                            const VectorX& mode_reach);

/// Largest speed of the shape's points relative to its body's origin [m/s].
[[nodiscard]] double find_own_speed(const Shape& shape,
                                    const VectorX& mode_reach,
                                    const joints::PairBody& body);

}  // namespace limber::contact
