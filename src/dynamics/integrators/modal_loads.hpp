// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "dynamics/system_state.hpp"
#include "flexbody/modal_response_load.hpp"

namespace limber::dynamics {

/// Whether all that drives a body's modes is known beforehand in closed form:
/// level `uncoupled`, no coupler, loads that are constant by pieces or
/// sinusoidal in time and fixed in the body (or the body in the world).
[[nodiscard]] bool has_closed_modal_loads(const SystemModel& model,
                                          BodyIndex body);

/// Everything that drives the modes of such a body, from the start on.
/// @param start its pose, which matters for a clamped body; its time [s]
[[nodiscard]] flexbody::ModalLoads find_modal_loads(const SystemModel& model,
                                                    BodyIndex body,
                                                    const SystemState& start);

}  // namespace limber::dynamics
