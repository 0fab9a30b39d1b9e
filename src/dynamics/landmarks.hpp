// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "dynamics/simulation.hpp"

namespace limber::dynamics {

/// A time that a step must end on.
struct Landmark {
  double time = 0.0;       ///< [s]
  bool is_jump = false;    ///< a load or its slope jumps
  bool is_output = false;  ///< the state is asked for
};

/// All landmarks after `start`, increasing; the last is the end. Times that
/// differ by round-off alone are one.
/// @throws InputError for steps so short that they cannot be told apart.
[[nodiscard]] std::vector<Landmark> find_landmarks(
    const SystemModel& model, double start, const SimulationSettings& settings);

/// Steps of the lengths that the settings have, between two times [-].
[[nodiscard]] double count_steps(const SimulationSettings& settings,
                                 double from, double until);

/// The longest step that the settings allow from time t on [s].
[[nodiscard]] double find_longest_step(const SimulationSettings& settings,
                                       double t);
/// And at any time.
[[nodiscard]] double find_longest_step(const SimulationSettings& settings);

}  // namespace limber::dynamics
