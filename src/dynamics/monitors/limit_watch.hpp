// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "common/archive.hpp"
#include "dynamics/event.hpp"
#include "dynamics/system_state.hpp"
#include "dynamics/workspace.hpp"

namespace limber::dynamics {

/// Watches when drives ask for more effort than their limit lets them give.
///
/// Limits     looks at the ends of steps; in between the ratio of both is taken
///            to change evenly.
class LimitWatch {
 public:
  explicit LimitWatch(const SystemModel& model);

  /// The end of a step. Adds an event where a drive reaches or leaves its
  /// limit, of each drive a thousand at most. @param terms at `state`
  void include(const SystemState& state, const SystemTerms& terms,
               std::vector<Event>& events);
  /// One for each drive that reached its limit.
  [[nodiscard]] std::vector<std::string> find_warnings() const;

  /// What it knows between steps.
  void exchange_memory(Archive& archive);

 private:
  struct Limited {
    bool is_transmission = false;
    std::size_t index = 0;       // of the coupler or the transmission
    std::size_t coordinate = 0;  // of a joint
    const joints::Drive* drive = nullptr;
    bool has_begun = false;
    double load = 0.0;        // asked effort over the limit, last [-]
    double time = 0.0;        // [s]
    double first_time = 0.0;  // at which it reached the limit [s]
    double first_z = 0.0;     // coordinate then [rad or m]
    double time_at = 0.0;     // in all [s]
    long events = 0;
  };
  [[nodiscard]] joints::ScalarMotion find_motion(
      const Limited& limited, const SystemState& state,
      const SystemTerms& terms) const;
  void pass(Limited& limited, const joints::ScalarMotion& motion, double load,
            double t, std::vector<Event>& events);
  [[nodiscard]] const std::string& name_of(const Limited& limited) const;

  const SystemModel& model_;
  std::vector<Limited> drives_;
};

}  // namespace limber::dynamics
