// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/system/system_state.hpp"
#include "limber/dynamics/system/unknowns.hpp"

/// A system's configuration and velocities by its unknowns (unknowns.hpp).
namespace limber::dynamics {

/// Moves a configuration by a fraction [-] of increments: rotations
/// by the exponential, in the body frame.
void displace(const SystemModel& model, const VectorX& increments,
              double fraction, SystemState& state);

/// The increments that displace `from` to `to`, of the same model.
[[nodiscard]] VectorX find_increments(const SystemModel& model,
                                      const SystemState& from,
                                      const SystemState& to);

/// The state's velocities. @param velocities of all unknowns
void get_velocities(const SystemModel& model, const SystemState& state,
                    VectorX& velocities);

/// Replaces the state's velocities, but not those of frames that are fixed or
/// follow nodes.
void set_velocities(const SystemModel& model, const VectorX& velocities,
                    SystemState& state);

}  // namespace limber::dynamics
