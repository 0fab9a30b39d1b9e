// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/landmarks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/errors.hpp"

namespace limber::dynamics {
namespace {

// Steps that see a half sine at their ends alone miss its impulse: none is left
// of it in one step, 1.3 % of it is lost in 8 and 0.3 % in 16.
constexpr int kLeastSteps = 16;

// Steps that can be told apart and counted: shorter ones are lost in the
// round-off of the time.
constexpr double kMostSteps = 1e12;

void check_step_count(const SimulationSettings& settings, double start) {
  const double count = count_steps(settings, start, settings.end_time);
  if (count <= kMostSteps) return;
  double shortest = settings.step;
  for (const StepChange& change : settings.step_changes) {
    shortest = std::min(shortest, change.step);
  }
  throw InputError(
      fmt::format("step {:.3g} s takes {:.3g} steps until {:g} s; at most {:g} "
                  "can be taken",
                  shortest, count, settings.end_time, kMostSteps));
}

bool has_longer_steps(const SimulationSettings& settings, double from,
                      double until, double length) {
  if (find_longest_step(settings, from) > length) return true;
  return std::any_of(settings.step_changes.begin(), settings.step_changes.end(),
                     [&](const StepChange& change) {
                       return change.from < until && change.step > length;
                     });
}

// Those within a pulse that steps are too long for. Of steps to a tolerance it
// is not known: an impulse that every pass misses alike is in no estimate.
std::vector<double> find_inner_times(const TimeFunction& function,
                                     const SimulationSettings& settings) {
  const auto* pulse = std::get_if<Pulse>(&function);
  if (pulse == nullptr || pulse->shape != PulseShape::half_sine) return {};
  const double part = pulse->duration / kLeastSteps;
  if (settings.tolerance == 0.0 &&
      !has_longer_steps(settings, pulse->start, pulse->start + pulse->duration,
                        part)) {
    return {};
  }
  std::vector<double> times;
  for (int i = 1; i < kLeastSteps; ++i) {
    times.push_back(pulse->start + i * part);
  }
  return times;
}

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
    for (const double t : find_inner_times(load.function, settings)) {
      add(t, false);
    }
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
  check_step_count(settings, start);
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

double count_steps(const SimulationSettings& settings, double from,
                   double until) {
  double count = 0.0;
  double step = settings.step;
  for (const StepChange& change : settings.step_changes) {
    const double end = std::clamp(change.from, from, until);
    count += (end - from) / step;
    from = end;
    step = change.step;
  }
  return count + (until - from) / step;
}

double find_longest_step(const SimulationSettings& settings, double t) {
  const double same = 1e-12 * settings.end_time;
  double step = settings.step;
  for (const StepChange& change : settings.step_changes) {
    if (change.from <= t + same) step = change.step;
  }
  return step;
}

double find_longest_step(const SimulationSettings& settings) {
  double longest = settings.step;
  for (const StepChange& change : settings.step_changes) {
    longest = std::max(longest, change.step);
  }
  return longest;
}

}  // namespace limber::dynamics
