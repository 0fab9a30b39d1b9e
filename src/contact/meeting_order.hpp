// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "limber/contact/law/point_memory.hpp"
#include "limber/contact/narrow_phase/meeting.hpp"

/// Keeps the order of features that have no fixed one
/// (ShapePair::has_loose_features), such as the nodes of a skin that touch.
namespace limber::contact {

/// Whether both are at one feature of a skin.
[[nodiscard]] bool is_at(const Meeting& meeting, const PointMemory& memory);

/// Puts those that touch where they are remembered.
/// @param memory kPointNumbers of each
void follow_memory(std::span<const double> memory, std::span<Meeting> out);

/// Puts the features into the order of `leader`; what is not there is far.
void follow(std::span<const Meeting> leader, std::span<Meeting> out);

}  // namespace limber::contact
