// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/common/records/fields.hpp"
#include "limber/dynamics/system/system_model.hpp"

namespace limber::dynamics {

/// Something that happened at a coupler, a transmission or a load.
struct Event {
  double time = 0.0;   ///< [s]
  std::string source;  ///< name of the coupler, transmission or load
  std::string what;    ///< "stop reached", "latched", "load edge", ...
  /// Rate of the triggering quantity: at a stop the speed of the joint [m/s or
  /// rad/s], at a latch that of the distance [m/s]; of a load 0.
  double rate = 0.0;
  /// Number of times that the step which ends there was repeated to locate it;
  /// 0: at the start, at a breakpoint, or at the end of a step that was not
  /// cut.
  int iterations = 0;

  bool operator==(const Event&) const = default;
};

constexpr auto fields_of(const Event*) {
  return list_fields("event", "time [s]", "source", "what", "rate [m/s, rad/s]",
                     "iterations");
}

/// Adds the times within (start, end) [s] at which loads start, jump or end,
/// for a long history only the first and the last; and sorts all events by
/// time.
void add_load_edges(const SystemModel& model, double start, double end,
                    std::vector<Event>& events);

}  // namespace limber::dynamics
