// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/terms/system_terms.hpp"

/// Motion of attachments on bodies of any kind and on the world; that at a
/// state alone: find_frame_motion() of system/system_state.hpp.
namespace limber::dynamics {

/// Fills the motion of all; needs R_WB.
void calc_attachments(const SystemModel& model, const SystemState& state,
                      SystemTerms& terms);

}  // namespace limber::dynamics
