// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "limber/dynamics/equations/energy.hpp"
#include "limber/dynamics/monitors/event.hpp"
#include "limber/dynamics/system/system_state.hpp"

namespace limber::results {

/// One scalar recorded over time.
struct ProbeColumn {
  std::string name;  ///< e.g. "finger_tip.ux"
  std::string unit;  ///< e.g. "m"
  /// Of all of the curve [unit]; NaN: not estimated.
  double error = std::numeric_limits<double>::quiet_NaN();
};

/// Results of a run in memory: one entry per output time, except in `events`.
struct History {
  std::vector<ProbeColumn> columns;
  std::vector<double> times;                    ///< [s]
  std::vector<std::vector<double>> probe_rows;  ///< [time][column]
  std::vector<dynamics::SystemState> states;
  std::vector<dynamics::EnergyBalance> energies;
  std::vector<dynamics::Event> events;  ///< sorted by time
};

}  // namespace limber::results
