// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/simulation/progress_pulse.hpp"

#include <algorithm>

#include "limber/dynamics/simulation/interrupted.hpp"

namespace limber::dynamics {
namespace {

constexpr long kMostStepsBetween = 64;
constexpr std::chrono::milliseconds kShortSilence(2);
constexpr std::chrono::milliseconds kLongSilence(20);
constexpr std::chrono::seconds kLongestWait(1);  // after the request

}  // namespace

void ProgressPulse::report(long steps, double fraction,
                           const Progress& progress) {
  const auto now = Clock::now();
  if (now - last_ < kShortSilence) {
    stride_ = std::min(2 * stride_, kMostStepsBetween);
  } else if (now - last_ > kLongSilence) {
    stride_ = std::max(stride_ / 2, 1L);
  }
  last_ = now;
  step_ = steps;
  try {
    limber::report(progress, "simulating", fraction);
  } catch (const Interrupted& asked) {
    if (!asked_) asked_ = now;
    words_ = asked.what();
  }
}

bool ProgressPulse::ends_here(bool is_even) const {
  return asked_ && (is_even || Clock::now() - *asked_ > kLongestWait);
}

}  // namespace limber::dynamics
