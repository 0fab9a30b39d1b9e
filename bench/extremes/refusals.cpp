// SPDX-License-Identifier: BSD-3-Clause
#include "refusals.hpp"

namespace limber::bench {

std::string find_kind(const std::string& text) {
  std::string kind;
  bool is_quoted = false;
  for (const char c : text) {
    if (c == '\'') is_quoted = !is_quoted;
    if (is_quoted || c == '\'' || (c >= '0' && c <= '9')) continue;
    kind += c == '\n' ? ' ' : c;
  }
  return kind.substr(0, 72);
}

}  // namespace limber::bench
