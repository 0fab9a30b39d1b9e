// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/dynamics/integrators/integrator_kind.hpp"
#include "limber/dynamics/monitors/energy_record.hpp"

/// Warnings and errors for energy that a run gained or lost.
namespace limber::dynamics {

/// Drifts of a group relative to its throughput above which a run gets a
/// warning, and is rejected. Exempt from rejection are integrators that damp
/// (implicit Euler) or have no consistent work (explicit Euler), and level
/// one-way, which has no feedback.
inline constexpr double kReportedDrift = 0.01;  ///< gives a warning [-]
inline constexpr double kMostDrift = 0.5;       ///< is rejected [-]

/// Adds a warning if a group gained or lost energy: size, time, place.
void warn_of_energy(IntegratorKind integrator, const EnergyRecord& energy,
                    std::vector<std::string>& warnings);

/// @throws NumericalError for a finished run with an invalid result: with size,
/// time and place.
void check_energy(IntegratorKind integrator, const EnergyRecord& energy);

}  // namespace limber::dynamics
