// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace limber {

/// "75 s", "12 min", "3.4 h". @param seconds [s]
[[nodiscard]] std::string to_duration(double seconds);

/// Separates a task from its expected duration in the text passed to a Progress
/// before long work that cannot report its fraction done.
inline constexpr std::string_view kDurationMark = ", about ";

/// "factorising, about 12 min" if it takes more than `least`, else `what`.
/// @param seconds, least [s]
[[nodiscard]] std::string with_duration(std::string_view what, double seconds,
                                        double least = 60.0);

/// [s]
[[nodiscard]] double seconds_since(std::chrono::steady_clock::time_point start);

}  // namespace limber
