// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/simulation/progress_pulse.hpp"

#include "limber/dynamics/simulation/interrupted.hpp"

namespace limber::dynamics {
namespace {

constexpr std::chrono::milliseconds kSilence(1);
// After the request, until a part of a step ends the run.
constexpr std::chrono::seconds kLongestWait(3);

}  // namespace

bool ProgressPulse::is_due() const {
  return !last_ || Clock::now() - *last_ > kSilence;
}

void ProgressPulse::report(double fraction, const Progress& progress) {
  last_ = Clock::now();
  try {
    limber::report(progress, "simulating", fraction);
  } catch (const Interrupted& requested) {
    if (!requested_) requested_ = last_;
    words_ = requested.what();
  }
}

bool ProgressPulse::ends_within_step() const {
  return requested_ && Clock::now() - *requested_ > kLongestWait;
}

}  // namespace limber::dynamics
