// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/duration.hpp"

#include <fmt/format.h>

namespace limber {

std::string to_duration(double seconds) {
  constexpr double kMinute = 60.0;
  constexpr double kHour = 3600.0;
  if (seconds < 1.5 * kMinute) return fmt::format("{:.0f} s", seconds);
  if (seconds < 1.5 * kHour)
    return fmt::format("{:.0f} min", seconds / kMinute);
  if (seconds < 48.0 * kHour) return fmt::format("{:.1f} h", seconds / kHour);
  return fmt::format("{:.0f} days", seconds / (24.0 * kHour));
}

std::string with_duration(std::string_view what, double seconds, double least) {
  if (!(seconds > least)) return std::string(what);
  return fmt::format("{}{}{}", what, kDurationMark, to_duration(seconds));
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start)
      .count();
}

}  // namespace limber
