// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/system/system_state.hpp"
#include "limber/flexbody/modal/modal_response_load.hpp"

namespace limber::dynamics {

/// Whether the modal loads of a body are known in advance in closed form: level
/// `uncoupled`, modes that are independent linear oscillators, no coupler,
/// loads that are piecewise constant or sinusoidal in time and fixed in the
/// body (or the body fixed in the world).
[[nodiscard]] bool has_closed_modal_loads(const SystemModel& model,
                                          BodyIndex body);

/// Loads on the modes of such a body, from the start on.
/// @param start supplies the body's pose, used if it is clamped, and the time
/// [s]
[[nodiscard]] flexbody::ModalLoads find_modal_loads(const SystemModel& model,
                                                    BodyIndex body,
                                                    const SystemState& start);

}  // namespace limber::dynamics
