// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/landmarks.hpp"

#include <algorithm>
#include <cmath>

namespace limber::dynamics {
namespace {

std::vector<Landmark> gather(const SystemModel& model, double start,
                             const SimulationSettings& settings) {
  std::vector<Landmark> marks;
  const auto add = [&](double t, bool is_jump) {
    if (t > start && t < settings.end_time) marks.push_back({t, is_jump});
  };
  for (const double t : settings.output_times) {
    if (t > start && t <= settings.end_time) marks.push_back({t, false, true});
  }
  for (const StepChange& change : settings.step_changes) {
    add(change.from, false);
  }
  for (const Load& load : model.loads) {
    for (const double t : break_times(load.function)) add(t, true);
  }
  for (const Coupler& coupler : model.couplers) {
    for (const double t : joints::break_times(coupler.law)) add(t, true);
  }
  for (const Transmission& transmission : model.transmissions) {
    for (const joints::ScalarLaw& law : transmission.laws) {
      for (const double t : joints::break_times(law)) add(t, true);
    }
  }
  for (const BodyLoad& load : model.body_loads) {
    for (const double t : load.history.times) add(t, true);
  }
  marks.push_back({settings.end_time});
  return marks;
}

}  // namespace

std::vector<Landmark> find_landmarks(const SystemModel& model, double start,
                                     const SimulationSettings& settings) {
  std::vector<Landmark> marks = gather(model, start, settings);
  std::stable_sort(
      marks.begin(), marks.end(),
      [](const Landmark& a, const Landmark& b) { return a.time < b.time; });
  // A jump's time wins, so that the load's own comparison with it is exact.
  const double same = 1e-12 * std::max(std::abs(start), settings.end_time);
  std::vector<Landmark> merged;
  for (const Landmark& mark : marks) {
    if (merged.empty() || mark.time - merged.back().time > same) {
      merged.push_back(mark);
      continue;
    }
    Landmark& last = merged.back();
    if (mark.is_jump) last.time = mark.time;
    last.is_jump |= mark.is_jump;
    last.is_output |= mark.is_output;
  }
  return merged;
}

double find_longest_step(const SimulationSettings& settings, double t) {
  const double same = 1e-12 * settings.end_time;
  double step = settings.step;
  for (const StepChange& change : settings.step_changes) {
    if (change.from <= t + same) step = change.step;
  }
  return step;
}

}  // namespace limber::dynamics
