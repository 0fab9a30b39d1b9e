// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace limber {

/// Longer names are refused when read.
constexpr std::size_t kMostNameBytes = 200;

/// What a user gave, fit to stand in a message: at most 200 characters of it,
/// control characters spelt out ("\x1b", "\n").
[[nodiscard]] std::string echo(std::string_view text);

/// The same of any length, line breaks left as they are: a whole message.
[[nodiscard]] std::string spell_out_controls(std::string_view message);

/// Whether it holds a byte 0, a line break, an escape or another control
/// character of ASCII or Unicode, which no name needs.
[[nodiscard]] bool has_control(std::string_view text);

}  // namespace limber
