// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "limber/common/records/archive.hpp"
#include "limber/dynamics/equations/placed_drive.hpp"
#include "limber/dynamics/monitors/event.hpp"
#include "limber/dynamics/system/system_state.hpp"

namespace limber::dynamics {

/// Monitors when drives request more effort than their limit.
///
/// Limits     evaluated at the ends of steps; in between the ratio is assumed
///            to vary linearly. Steps to a tolerance end there
///            (limit_crossing.hpp).
class EffortLimitObserver {
 public:
  explicit EffortLimitObserver(const SystemModel& model);

  /// The end of a step. Adds an event when a drive reaches or leaves its limit,
  /// at most a thousand per drive. @param terms at `state`
  void include(const SystemState& state, const SystemTerms& terms,
               std::vector<Event>& events);
  /// One for each drive that reached its limit.
  [[nodiscard]] std::vector<std::string> find_warnings() const;

  /// Saves or restores its state for checkpoints.
  void exchange_memory(Archive& archive);

 private:
  struct Limited {
    PlacedDrive drive;
    bool has_begun = false;
    double load = 0.0;        // last requested effort over the limit [-]
    double time = 0.0;        // [s]
    double first_time = 0.0;  // at which it first reached the limit [s]
    double first_z = 0.0;     // coordinate then [rad or m]
    double time_at = 0.0;     // total time at the limit [s]
    long events = 0;
  };
  void pass(Limited& limited, const joints::ScalarMotion& motion, double load,
            double t, std::vector<Event>& events);

  const SystemModel& model_;
  std::vector<Limited> drives_;
};

}  // namespace limber::dynamics
