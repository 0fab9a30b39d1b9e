// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/text/key_depth.hpp"

#include <algorithm>
#include <cctype>
#include <string>

namespace limber::scene {
namespace {

// Position after the string that begins at `at`; if unterminated, the end of
// its line or, for triple quotes, of the text.
std::size_t skip_string(std::string_view text, std::size_t at) {
  const char quote = text[at];
  const std::string_view triple = text.substr(at, 3);
  const bool is_long = triple.size() == 3 && triple == std::string(3, quote);
  const std::string_view mark = text.substr(at, is_long ? 3 : 1);
  for (at += mark.size(); at < text.size(); ++at) {
    if (text.substr(at).starts_with(mark)) return at + mark.size();
    if (text[at] == '\n' && !is_long) return at;
    if (text[at] == '\\' && quote == '"') ++at;
  }
  return text.size();
}

bool is_bare(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' ||
         c == '-';
}

}  // namespace

std::optional<int> find_overlong_key(std::string_view toml) {
  int parts = 1;  // of the current key or value
  for (std::size_t at = 0; at < toml.size();) {
    const char c = toml[at];
    if (c == '"' || c == '\'') {
      at = skip_string(toml, at);
      continue;
    }
    if (c == '#') {
      at = std::min(toml.find('\n', at), toml.size());
      continue;
    }
    if (c == '.') {
      ++parts;
    } else if (!is_bare(c) && c != ' ' && c != '\t') {
      parts = 1;
    }
    if (parts > kMostKeyParts) {
      const auto end = toml.begin() + static_cast<std::ptrdiff_t>(at);
      return 1 + static_cast<int>(std::count(toml.begin(), end, '\n'));
    }
    ++at;
  }
  return std::nullopt;
}

}  // namespace limber::scene
