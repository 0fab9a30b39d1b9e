// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/echo.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "limber/common/utf8.hpp"

namespace limber {
namespace {

constexpr std::size_t kMostCharacters = 200;
constexpr std::size_t kOne = 1;  // byte that is not UTF-8

unsigned char byte_at(std::string_view text, std::size_t at) {
  return static_cast<unsigned char>(text[at]);
}

// Length in bytes of the control character at `at`, or 0. In UTF-8 U+0080 to
// U+009F take two.
std::size_t measure_control(std::string_view text, std::size_t at) {
  const unsigned char first = byte_at(text, at);
  if (first < 0x20 || first == 0x7f) return 1;
  if (first != 0xc2 || at + 1 == text.size()) return 0;
  const unsigned char second = byte_at(text, at + 1);
  return second >= 0x80 && second < 0xa0 ? 2 : 0;
}

std::string spell_out(std::string_view control) {
  if (control == "\n") return "\\n";
  if (control == "\t") return "\\t";
  std::string text;
  for (std::size_t i = 0; i < control.size(); ++i) {
    text += fmt::format("\\x{:02x}", byte_at(control, i));
  }
  return text;
}

// Length in bytes of at most this many characters; a byte that is not UTF-8
// counts as one.
std::size_t measure_start(std::string_view text, std::size_t characters) {
  std::size_t at = 0;
  for (std::size_t i = 0; i < characters && at < text.size(); ++i) {
    at += std::max(measure_utf8(text, at), kOne);
  }
  return at;
}

std::string rewrite(std::string_view text, bool keeps_lines) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = measure_utf8(text, at);
    const std::string_view one = text.substr(at, std::max(length, kOne));
    const bool is_shown = length > 0 && measure_control(one, 0) == 0;
    out += is_shown || (keeps_lines && one == "\n") ? std::string(one)
                                                    : spell_out(one);
    at += one.size();
  }
  return out;
}

}  // namespace

std::string echo(std::string_view text) {
  const std::size_t shown = measure_start(text, kMostCharacters);
  std::string out = rewrite(text.substr(0, shown), false);
  if (shown < text.size()) {
    out += fmt::format("... ({} bytes in all)", text.size());
  }
  return out;
}

std::string escape_controls(std::string_view message) {
  return rewrite(message, true);
}

bool has_control(std::string_view text) {
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (measure_control(text, at) > 0) return true;
  }
  return false;
}

}  // namespace limber
