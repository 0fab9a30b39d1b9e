// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "dynamics/simulation.hpp"

namespace limber::dynamics {

/// Tells whether a checkpoint is of this run: a digest of the bodies, the
/// initial state, the settings, and the forces that the initial state feels at
/// the start, at the end and when loads or drives change.
[[nodiscard]] std::string find_fingerprint(const SystemModel& model,
                                           const SystemState& initial,
                                           const SimulationSettings& settings);

}  // namespace limber::dynamics
