// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "limber/common/types.hpp"
#include "limber/contact/shapes/shape.hpp"
#include "limber/joints/pairs/pair_interaction.hpp"

namespace limber::contact {

/// In words, such as "half space".
[[nodiscard]] std::string name_kind(const Shape& shape);

/// @throws InputError if a size is not positive and finite, the pose is no
/// rigid one, or a Skin is missing or not at the body's own frame.
void check_shape(const Shape& shape);

/// Modes of the body that move the shape: 0 but for a Skin.
[[nodiscard]] int count_modes(const Shape& shape);

/// The modes' rows at a place of a shape: it is at x_B + out eta. All zero for
/// a shape that does not deform. Allocates nothing.
/// @param out 3 x m of the body [kg^-1/2]
/// @throws ContractError if a Skin has another number of modes.
void set_shape_functions(const Shape& shape, const SurfacePlace& place,
                         Matrix3X& out);

/// Displacement per force on the place that the modes leave out, 0 for shapes
/// that do not deform [m/N].
[[nodiscard]] double find_residual(const Shape& shape,
                                   const SurfacePlace& place);

/// An upper bound of the distance of the shape's points from Bo, as the body
/// is deformed; infinite for a half space [m].
[[nodiscard]] double find_extent(const Shape& shape,
                                 const joints::PairBody& body);

}  // namespace limber::contact
