// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "limber/contact/narrow_phase/meeting.hpp"

namespace limber::contact {

/// Gives features that have no order of their own the slots in which their
/// points' memories are: that of the memory whose places on both bodies are
/// nearest, closest pairs first; new features get slots without a memory.
///
/// Limits     a feature farther than `reach` from any memory is new; where
///            there is no slot without a memory it takes over another's
/// @param memory of the points, kPointNumbers each; as many as meetings
/// @param reach > 0 [m]
void take_slots(std::span<const double> memory, double reach,
                std::span<Meeting> meetings);

/// The same, those of other features, such as at a step's begin.
void take_slots(std::span<const Meeting> others, double reach,
                std::span<Meeting> meetings);

}  // namespace limber::contact
