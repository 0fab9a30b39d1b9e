// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/monitors/effort_limit_observer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace limber::dynamics {
namespace {

constexpr long kMostEvents = 1000;

}  // namespace

EffortLimitObserver::EffortLimitObserver(const SystemModel& model)
    : model_(model) {
  for (const PlacedDrive& drive : find_limited_drives(model)) {
    drives_.push_back({.drive = drive});
  }
}

void EffortLimitObserver::pass(Limited& limited,
                               const joints::ScalarMotion& motion, double load,
                               double t, std::vector<Event>& events) {
  const double span = limited.has_begun ? t - limited.time : 0.0;
  const double rise = load - limited.load;
  const double fraction =
      span > 0.0 && rise != 0.0 ? (1.0 - limited.load) / rise : 1.0;
  const double when = t - (1.0 - fraction) * span;
  const bool is_reached = load >= 1.0;
  if (is_reached && limited.events == 0) {
    limited.first_time = when;
    limited.first_z = motion.z - (1.0 - fraction) * span * motion.rate;
  }
  limited.time_at += is_reached ? t - when : when - limited.time;
  if (++limited.events > kMostEvents) return;
  events.push_back({when, name_of(limited.drive, model_),
                    is_reached ? "effort limit reached" : "effort limit left",
                    motion.rate});
}

void EffortLimitObserver::include(const SystemState& state,
                                  const SystemTerms& terms,
                                  std::vector<Event>& events) {
  for (Limited& limited : drives_) {
    const joints::ScalarMotion motion =
        find_motion(model_, state, terms, limited.drive);
    const double load = joints::find_load(*limited.drive.law, motion,
                                          now_of(state, Side::left));
    const bool was_at = limited.has_begun && limited.load >= 1.0;
    const bool is_at = load >= 1.0;
    if (was_at != is_at) {
      pass(limited, motion, load, state.t, events);
    } else if (is_at) {
      limited.time_at += state.t - limited.time;
    }
    limited.load = load;
    limited.time = state.t;
    limited.has_begun = true;
  }
}

std::vector<std::string> EffortLimitObserver::find_warnings() const {
  std::vector<std::string> warnings;
  for (const Limited& limited : drives_) {
    if (limited.events == 0) continue;
    warnings.push_back(fmt::format(
        "the drive of '{}' reaches its largest effort of {:g} at t = {:.6g} s, "
        "where its coordinate is {:.6g}; it is at this limit for {:.3g} s in "
        "total and does not follow its signal",
        name_of(limited.drive, model_), joints::max_effort(*limited.drive.law),
        limited.first_time, limited.first_z, limited.time_at));
  }
  return warnings;
}

void EffortLimitObserver::exchange_memory(Archive& archive) {
  for (Limited& limited : drives_) {
    archive(limited.has_begun, limited.load, limited.time, limited.first_time,
            limited.first_z, limited.time_at, limited.events);
  }
}

}  // namespace limber::dynamics
