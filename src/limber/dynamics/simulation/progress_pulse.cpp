// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/simulation/progress_pulse.hpp"

#include <fmt/format.h>

#include "limber/dynamics/simulation/breakpoints.hpp"
#include "limber/dynamics/simulation/interrupted.hpp"

namespace limber::dynamics {
namespace {

constexpr std::chrono::milliseconds kSilence(1);
// After the request, until a part of a step ends the run.
constexpr std::chrono::seconds kLongestWait(3);

}  // namespace

void ProgressPulse::beat(double t) {
  report(t);
  if (requested_) end(t);
}

void ProgressPulse::beat_within_step(double t) {
  report(t);
  if (requested_ && Clock::now() - *requested_ > kLongestWait) end(t);
}

void ProgressPulse::report(double t) {
  if (last_ && Clock::now() - *last_ <= kSilence) return;
  last_ = Clock::now();
  try {
    limber::report(progress_, "simulating", find_fraction(t));
  } catch (const Interrupted& requested) {
    if (!requested_) requested_ = last_;
    words_ = requested.what();
  }
}

// Of the steps; of the time, if their number depends on a tolerance.
double ProgressPulse::find_fraction(double t) const {
  const double end = settings_.end_time;
  if (settings_.tolerance > 0.0) return (t - start_) / (end - start_);
  return count_steps(settings_, start_, t) /
         count_steps(settings_, start_, end);
}

void ProgressPulse::end(double t) const {
  throw Interrupted(fmt::format("{} at t = {:.9g} s", words_, t));
}

}  // namespace limber::dynamics
