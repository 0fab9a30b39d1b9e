// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/console/time_estimate.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace limber::app {

void TimeEstimate::note(std::string_view what, double fraction, double now) {
  fraction = std::clamp(fraction, 0.0, 1.0);
  if (what != what_ || fraction < fraction_) {
    what_ = what;
    start_ = now;
    first_ = fraction;
  }
  now_ = now;
  fraction_ = fraction;
}

std::optional<double> TimeEstimate::left() const {
  if (!(fraction_ > first_) || !(now_ > start_)) return std::nullopt;
  return (now_ - start_) * (1.0 - fraction_) / (fraction_ - first_);
}

std::string TimeEstimate::take_announcement() {
  const bool has_duration = what_.find(kDurationMark) != std::string::npos;
  if (has_duration && announced_.insert(what_).second) return what_;
  const double measured = now_ - start_;
  const std::optional<double> rest = left();
  if (!rest || measured < kPiece || measured + *rest < kLong) return "";
  if (!announced_.insert(what_).second) return "";
  return fmt::format("{}: about {} remaining, estimated from its first {}",
                     what_, to_duration(*rest), to_duration(measured));
}

}  // namespace limber::app
