// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/simulation/breakpoints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "limber/common/errors.hpp"

namespace limber::dynamics {
namespace {

// Of a time that is a sum of some others [-].
constexpr double kSame = 8.0 * std::numeric_limits<double>::epsilon();

// Steps per half sine. Forces sampled at the ends of steps miss part of its
// impulse: all of it with one step, 1.3 % with 8 and 0.3 % with 16.
constexpr int kLeastSteps = 16;

// Largest number of steps: shorter ones are below the resolution of the time.
constexpr double kMostStepsOfRun = 1e12;

// Largest number of samples of one controller, each of which is a breakpoint;
// and their least distance, relative to the resolution of the time.
constexpr double kMostSamples = 1e7;
constexpr double kFewestSame = 100.0;

void check_step_count(const SimulationSettings& settings, double start) {
  const double count = count_steps(settings, start, settings.end_time);
  if (count <= kMostStepsOfRun) return;
  double shortest = settings.step;
  for (const StepChange& change : settings.step_changes) {
    shortest = std::min(shortest, change.step);
  }
  throw InputError(
      fmt::format("step {:.3g} s needs {:.3g} steps until {:g} s; at most {:g} "
                  "are possible",
                  shortest, count, settings.end_time, kMostStepsOfRun));
}

// Breakpoints within pulses that steps would not resolve. Steps to a tolerance
// always get them: an impulse that all passes miss is in no estimate.
std::vector<double> find_inner_times(const TimeFunction& function,
                                     const SimulationSettings& settings) {
  const auto* pulse = std::get_if<Pulse>(&function);
  if (pulse == nullptr || pulse->shape != PulseShape::half_sine) return {};
  const double part = pulse->duration / kLeastSteps;
  if (settings.tolerance == 0.0 &&
      find_longest_step(settings, pulse->start,
                        pulse->start + pulse->duration) <= part) {
    return {};
  }
  std::vector<double> times;
  for (int i = 1; i < kLeastSteps; ++i) {
    times.push_back(pulse->start + i * part);
  }
  return times;
}

// Those after the start.
void add_samples(const ControllerModel& controller, double start,
                 const SimulationSettings& settings,
                 std::vector<Breakpoint>& marks) {
  const double end = settings.end_time;
  const double same = find_same_time(end, start);
  const double count =
      (end - std::max(start, controller.offset)) / controller.period;
  if (count > kMostSamples || controller.period < kFewestSame * same) {
    throw InputError(fmt::format(
        "controller '{}': a sample every {:.3g} s needs {:.3g} samples from "
        "{:g} s to {:g} s; at most {:g}, {:.2g} s apart, are possible",
        controller.name, controller.period, count, start, end, kMostSamples,
        kFewestSame * same));
  }
  const double same_as_start = find_same_time(start, start);
  for (long k = controller.find_first(start, same_as_start);; ++k) {
    const double t = controller.find_time(k);
    if (t <= start + same_as_start) continue;
    if (t > end + same) return;
    marks.push_back({.time = std::min(t, end), .is_sample = true});
  }
}

std::vector<Breakpoint> gather(const SystemModel& model, double start,
                               const SimulationSettings& settings,
                               bool has_outputs) {
  std::vector<Breakpoint> marks;
  const auto add = [&](double t, bool is_jump) {
    if (t > start && t < settings.end_time) marks.push_back({t, is_jump});
  };
  for (const double t : settings.output_times) {
    if (has_outputs && t > start && t <= settings.end_time)
      marks.push_back({t, false, true});
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
  for (const ControllerModel& controller : model.controllers) {
    add_samples(controller, start, settings, marks);
  }
  marks.push_back({settings.end_time});
  return marks;
}

}  // namespace

std::vector<Breakpoint> find_breakpoints(const SystemModel& model, double start,
                                         const SimulationSettings& settings,
                                         bool has_outputs) {
  check_step_count(settings, start);
  std::vector<Breakpoint> marks = gather(model, start, settings, has_outputs);
  std::stable_sort(
      marks.begin(), marks.end(),
      [](const Breakpoint& a, const Breakpoint& b) { return a.time < b.time; });
  // The jump's time is kept, so that the load's comparison with it is exact.
  std::vector<Breakpoint> merged;
  for (const Breakpoint& mark : marks) {
    if (merged.empty() ||
        mark.time - merged.back().time > find_same_time(mark.time, start)) {
      merged.push_back(mark);
      continue;
    }
    Breakpoint& last = merged.back();
    if (mark.is_jump) last.time = mark.time;
    last.is_jump |= mark.is_jump;
    last.is_output |= mark.is_output;
    last.is_sample |= mark.is_sample;
  }
  return merged;
}

double find_same_time(double t, double start) {
  return kSame * std::max(std::abs(t), std::abs(start));
}

double find_time_after(double t) {
  return t + std::max(2.0 * find_same_time(t, t),
                      std::numeric_limits<double>::min());
}

void BreakpointQueue::pass() {
  const double passed = next().time;
  if (!is_stop_next_) ++next_;
  const bool was_stop = stop_.time <= passed + find_same_time(passed, start_);
  stop_at(was_stop ? kNever : stop_.time);
}

void BreakpointQueue::stop_at(double t) {
  stop_.time = t;
  is_stop_next_ =
      !is_empty() && t < all_[next_].time - find_same_time(t, start_);
}

long count_equal_steps(const SimulationSettings& settings, double from,
                       double to) {
  constexpr double kRounding = 4.0 * std::numeric_limits<double>::epsilon();
  const double span =
      to - from - kRounding * std::max(std::abs(from), std::abs(to));
  const double count = span / find_longest_step(settings, from);
  return std::max(static_cast<long>(std::ceil(count * (1.0 - 1e-12))), 1L);
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
  double step = settings.step;
  for (const StepChange& change : settings.step_changes) {
    if (change.from <= t + find_same_time(t, change.from)) step = change.step;
  }
  return step;
}

double find_longest_step(const SimulationSettings& settings, double from,
                         double until) {
  double longest = find_longest_step(settings, from);
  for (const StepChange& change : settings.step_changes) {
    const bool is_within = change.from > from && change.from < until;
    if (is_within) longest = std::max(longest, change.step);
  }
  return longest;
}

double find_longest_step(const SimulationSettings& settings) {
  double longest = settings.step;
  for (const StepChange& change : settings.step_changes) {
    longest = std::max(longest, change.step);
  }
  return longest;
}

std::vector<double> find_visited_times(const SystemModel& model, double start,
                                       const SimulationSettings& settings) {
  if (settings.tolerance > 0.0) return settings.output_times;
  std::vector<double> times;
  const auto& outputs = settings.output_times;
  if (!outputs.empty() && outputs.front() <= start) times.push_back(start);
  for (const Breakpoint& mark : find_breakpoints(model, start, settings)) {
    if (mark.is_output) times.push_back(mark.time);
  }
  return times;
}

}  // namespace limber::dynamics
