// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "limber/contact/law/point_memory.hpp"
#include "limber/contact/narrow_phase/meeting.hpp"

/// Keeps the order of features without a fixed one
/// (ShapePair::has_loose_features), such as the nodes of a skin that touch.
namespace limber::contact {

/// Whether both are at the same feature of a skin.
[[nodiscard]] bool is_at(const Meeting& meeting, const PointMemory& memory);

/// Moves the features that touch to the indices of their memories.
/// @param memory kPointNumbers of each
void follow_memory(std::span<const double> memory, std::span<Meeting> out);

/// Puts the features into the order of `leader`, missing ones as far away.
void follow(std::span<const Meeting> leader, std::span<Meeting> out);

}  // namespace limber::contact
