// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "limber/common/types.hpp"
#include "limber/contact/shapes/shape.hpp"
#include "limber/joints/pairs/pair_interaction.hpp"

namespace limber::contact {

/// The kind in words, such as "half space".
[[nodiscard]] std::string name_kind(const Shape& shape);

/// @throws InputError if a size is not positive and finite, the pose is not
/// rigid, or a MeshSurface is missing or not at the body's own frame.
void check_shape(const Shape& shape);

/// Number of the body's modes that move the shape: 0 except for a MeshSurface.
[[nodiscard]] int count_modes(const Shape& shape);

/// An upper bound of the distance of the deformed shape's points from Bo;
/// infinite for a half space [m].
[[nodiscard]] double find_extent(const Shape& shape,
                                 const joints::PairBody& body);

}  // namespace limber::contact
