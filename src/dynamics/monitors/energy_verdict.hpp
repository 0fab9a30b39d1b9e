// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "dynamics/energy_record.hpp"
#include "dynamics/simulation.hpp"

/// What is said of energy that a run made or lost.
namespace limber::dynamics {

/// Of the throughput: a drift beyond it is told, one beyond the other ends a
/// run, unless its integrator is known to damp (implicit Euler) or has no work
/// of its own (explicit Euler), or a level takes nothing back (one-way).
inline constexpr double kToldDrift = 0.01;
inline constexpr double kMostDrift = 0.5;

/// Drift over throughput [-]; 0 if it may be round-off.
[[nodiscard]] double find_open_share(const EnergyRecord& energy);

/// Adds a warning if energy was made or lost: size, time, place.
void warn_of_energy(IntegratorKind integrator, const EnergyRecord& energy,
                    std::vector<std::string>& warnings);

/// @throws NumericalError for a run that has ended and is no result: with
/// size, time and place.
void check_energy(IntegratorKind integrator, const EnergyRecord& energy);

}  // namespace limber::dynamics
