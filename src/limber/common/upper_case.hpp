// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <string>

namespace limber {

/// Independent of the locale; characters that are not ASCII letters are
/// unchanged.
[[nodiscard]] constexpr char to_upper(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

/// Independent of the locale; '?' for characters that are not ASCII.
[[nodiscard]] inline std::string to_upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](char c) {
    if (static_cast<unsigned char>(c) >= 0x80) return '?';
    return to_upper(c);
  });
  return text;
}

}  // namespace limber
