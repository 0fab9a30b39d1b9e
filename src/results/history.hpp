// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "dynamics/energy.hpp"
#include "dynamics/event.hpp"
#include "dynamics/system_state.hpp"

namespace limber::results {

/// One scalar that is followed in time.
struct ProbeColumn {
  std::string name;  ///< e.g. "finger_tip.ux"
  std::string unit;  ///< e.g. "m"
};

/// What a run leaves in memory: one entry an output time everywhere but in
/// `events`.
struct History {
  std::vector<ProbeColumn> columns;
  std::vector<double> times;                    ///< [s]
  std::vector<std::vector<double>> probe_rows;  ///< [time][column]
  std::vector<dynamics::SystemState> states;
  std::vector<dynamics::EnergyBalance> energies;
  std::vector<dynamics::Event> events;  ///< in the order of time
};

}  // namespace limber::results
