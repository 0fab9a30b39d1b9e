// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "dynamics/workspace.hpp"

/// The coordinate of a transmission, a path's length or a sum of joints'
/// coordinates, and what acts along it.
namespace limber::dynamics {

[[nodiscard]] std::vector<TransmissionTerms> make_transmission_terms(
    const SystemModel& model);

/// Fills the motion and the gradients; needs the attachments' motion, and that
/// of the couplers.
/// @throws NumericalError where two points of a path meet.
void calc_coordinate(const SystemModel& model, const SystemState& state,
                     const Transmission& transmission, const SystemTerms& terms,
                     TransmissionTerms& out);

/// The sum of what all its laws answer, with their switches where `memory` has
/// them.
[[nodiscard]] joints::ScalarResponse evaluate_laws(
    const Transmission& transmission, const joints::ScalarMotion& motion,
    const joints::CouplerMemory& memory, const Instant& now);

/// The motion alone, at a state.
[[nodiscard]] joints::ScalarMotion find_motion(
    const SystemModel& model, const SystemState& state,
    const Transmission& transmission);

}  // namespace limber::dynamics
