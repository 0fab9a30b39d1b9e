// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace limber {

/// Longer names are refused when read.
constexpr std::size_t kMostNameBytes = 200;

/// User input made safe to quote in a message: at most 200 characters, control
/// characters and bytes that are not UTF-8 escaped ("\x1b", "\n", "\xff").
[[nodiscard]] std::string echo(std::string_view text);

/// The same for a whole message: any length, line breaks unchanged.
[[nodiscard]] std::string escape_controls(std::string_view message);

/// Whether the text contains a zero byte, line break, escape or other ASCII or
/// Unicode control character, which no name needs.
[[nodiscard]] bool has_control(std::string_view text);

}  // namespace limber
