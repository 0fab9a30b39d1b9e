// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/dynamics/system/system_model.hpp"

namespace limber::dynamics {

/// A load or the command of a drive that is periodic for a time.
struct Oscillation {
  std::string name;       ///< "load 'l'", "the drive of 'j'"
  double period = 0.0;    ///< of its fastest term, > 0 [s]
  double from = 0.0;      ///< [s]
  double until = kNever;  ///< [s]
};

/// Sinusoids and sums of them of all loads, and sines that drives of joints and
/// transmissions follow. Inputs are known at samples only, and belong to none.
[[nodiscard]] std::vector<Oscillation> find_oscillations(
    const SystemModel& model);

/// That with the shortest period of those that act at time t [s]; null if none
/// does.
[[nodiscard]] const Oscillation* find_fastest(
    const std::vector<Oscillation>& oscillations, double t);

}  // namespace limber::dynamics
