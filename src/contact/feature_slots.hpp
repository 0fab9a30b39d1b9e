// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "limber/contact/narrow_phase/meeting.hpp"

namespace limber::contact {

/// Assigns features without a fixed order to memory slots: each feature to the
/// slot whose places on both bodies are nearest, closest pairs first; new
/// features to slots without a memory.
///
/// Limits     a feature farther than `reach` from every memory is new; if no
///            slot is free it overwrites another's memory
/// @param memory of the points, kPointNumbers each; as many as meetings
/// @param reach > 0 [m]
void take_slots(std::span<const double> memory, double reach,
                std::span<Meeting> meetings);

/// The same with the slots of other features, such as those at a step's begin.
void take_slots(std::span<const Meeting> others, double reach,
                std::span<Meeting> meetings);

}  // namespace limber::contact
