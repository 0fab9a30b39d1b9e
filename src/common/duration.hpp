// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace limber {

/// "75 s", "12 min", "3.4 h". @param seconds [s]
[[nodiscard]] std::string to_duration(double seconds);

/// What stands between work and how long it is expected to take, in words that
/// a Progress gets before long work that cannot tell how far it is.
inline constexpr std::string_view kForetold = ", about ";

/// "factorising, about 12 min" of what takes more than `least`, else `what`.
/// @param seconds, least [s]
[[nodiscard]] std::string foretell(std::string_view what, double seconds,
                                   double least = 60.0);

}  // namespace limber
