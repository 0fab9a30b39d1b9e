// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "limber/contact/potential/depth_field.hpp"
#include "limber/contact/potential/ruled_surface.hpp"

namespace limber::contact {

/// The lines of a surface that enter a body.
struct TouchedPart {
  Span u;                           ///< of the lines
  double depth = 0.0;               ///< of the deepest point [m]
  Vector3 place = Vector3::Zero();  ///< of it
};

/// @param body in the same frame as the surface
/// @returns nothing if no line enters it
/// Limits     of a surface that enters at separate places, the deepest one
[[nodiscard]] std::optional<TouchedPart> find_touched_part(
    const RuledSurface& surface, const DepthField& body);

using Cuts = StackArray<double, 512>;

/// Ascending values of u between which the part of the line within the body has
/// the same ends and faces, both ends of `part` included.
void find_cuts(const RuledSurface& surface, const DepthField& body,
               const Span& part, Cuts& out);

}  // namespace limber::contact
