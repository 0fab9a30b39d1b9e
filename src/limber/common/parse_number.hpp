// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace limber {

/// The number in `text`: decimal with optional exponent and leading '+', as
/// std::from_chars reads it, independent of the locale. Empty unless the whole
/// text is a number that a double can hold: not infinity, nan or 1e400.
[[nodiscard]] std::optional<double> parse_number(std::string_view text);

/// Words separated by blanks, tabs and line breaks.
[[nodiscard]] std::vector<std::string_view> split_words(std::string_view line);

}  // namespace limber
