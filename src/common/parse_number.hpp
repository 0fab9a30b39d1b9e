// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace limber {

/// The number that `text` is, all of it: decimal, with an exponent or not, as
/// std::from_chars reads it, so by no locale; a '+' may stand in front.
/// Nothing if it is none, or has no double: infinity, nan, 1e400.
[[nodiscard]] std::optional<double> parse_number(std::string_view text);

/// Words between blanks, tabs and line breaks.
[[nodiscard]] std::vector<std::string_view> split_words(std::string_view line);

}  // namespace limber
