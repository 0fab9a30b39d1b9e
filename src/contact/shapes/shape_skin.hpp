// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/contact/shapes/shape.hpp"

namespace limber::contact {

/// The surface of a box, a capsule or a cylinder as a Skin without modes, in
/// the body frame; a Skin unchanged.
///
/// Limits     a capsule has quadratic faces, 32 around, which deviate from its
///            surface by 1.5e-5 of its radius, at its ends by up to 1e-4; a
///            cylinder's side has 48 around, and its ends as many straight
///            edges, inside the rim by up to 2e-3 of the radius
/// @throws ContractError for another kind.
[[nodiscard]] Shape make_skin(const Shape& shape);

}  // namespace limber::contact
