// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/monitors/event.hpp"

#include <algorithm>

namespace limber::dynamics {
namespace {

// With more edges only the first and the last are events.
constexpr std::size_t kFewEdges = 4;

void add_edges(const std::string& name, std::vector<double> times, double start,
               double end, std::vector<Event>& events) {
  if (times.size() > kFewEdges) times = {times.front(), times.back()};
  for (const double t : times) {
    if (t > start && t < end) events.push_back({t, name, "load edge"});
  }
}

}  // namespace

void add_load_edges(const SystemModel& model, double start, double end,
                    std::vector<Event>& events) {
  for (const Load& load : model.loads) {
    add_edges(load.name, break_times(load.function), start, end, events);
  }
  for (const BodyLoad& load : model.body_loads) {
    add_edges(load.name, load.history.times, start, end, events);
  }
  std::stable_sort(
      events.begin(), events.end(),
      [](const Event& a, const Event& b) { return a.time < b.time; });
}

}  // namespace limber::dynamics
