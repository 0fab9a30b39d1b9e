// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/dynamics/terms/system_terms.hpp"

/// The coordinate of a transmission, a path's length or a sum of joints'
/// coordinates, and the forces along it.
namespace limber::dynamics {

[[nodiscard]] std::vector<TransmissionTerms> make_transmission_terms(
    const SystemModel& model);

/// Fills the motion and the gradients; needs the motion of attachments and
/// couplers.
/// @throws NumericalError if two points of a path coincide.
void calc_coordinate(const SystemModel& model, const SystemState& state,
                     const Transmission& transmission, const SystemTerms& terms,
                     TransmissionTerms& out);

/// Total response of all its laws, with the switches of `memory`.
[[nodiscard]] joints::ScalarResponse evaluate_laws(
    const Transmission& transmission, const joints::ScalarMotion& motion,
    const joints::CouplerMemory& memory, const EvaluationTime& now);

/// Only the motion, at a state.
[[nodiscard]] joints::ScalarMotion find_motion(
    const SystemModel& model, const SystemState& state,
    const Transmission& transmission);

}  // namespace limber::dynamics
