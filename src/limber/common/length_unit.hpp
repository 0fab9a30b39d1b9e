// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string_view>

namespace limber {

/// Description of a valid length unit, for messages.
inline constexpr std::string_view kLengthUnits =
    "m, cm, mm, in, ft, or a positive number of metres";

/// Metres of a length unit. Empty unless it is one of kLengthUnits.
[[nodiscard]] std::optional<double> parse_length_unit(std::string_view text);

/// Whether decks with this unit of length have forces in N: m, cm, mm. Those in
/// inches or feet have them in pounds or in newtons. @param metres of the unit
[[nodiscard]] bool is_metric(double metres);

/// Description of a valid unit of force, for messages.
inline constexpr std::string_view kForceUnits =
    "N, kN, lbf, or a positive number of newtons";

/// Newtons of a unit of force. Empty unless it is one of kForceUnits.
[[nodiscard]] std::optional<double> parse_force_unit(std::string_view text);

}  // namespace limber
