// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "limber/common/files/spilled_list.hpp"
#include "limber/dynamics/equations/motion_fields.hpp"
#include "limber/dynamics/monitors/event.hpp"

namespace limber::results {

/// One scalar recorded over time.
struct ProbeColumn {
  std::string name;  ///< e.g. "finger_tip.ux"
  std::string unit;  ///< e.g. "m"
  /// Of all of the curve [unit]; NaN: not estimated.
  double error = std::numeric_limits<double>::quiet_NaN();
};

/// States of a run at its outputs.
using States = SpilledList<dynamics::SystemState>;

/// Results of a run: one entry per output time, except in `events`. Only the
/// times are in memory, whatever the number of outputs.
struct History {
  std::vector<ProbeColumn> columns;
  std::vector<double> times;                    ///< [s]
  SpilledList<std::vector<double>> probe_rows;  ///< [time][column]
  States states;
  SpilledList<dynamics::EnergyBalance> energies;
  std::vector<dynamics::Event> events;  ///< sorted by time
};

/// Indices of the outputs, of so many, that a curve is drawn through: all, or
/// every k-th and the last, since more than some thousand are
/// indistinguishable in a picture.
[[nodiscard]] std::vector<std::size_t> list_drawn_outputs(std::size_t count);

}  // namespace limber::results
