// SPDX-License-Identifier: BSD-3-Clause
#include "refusals.hpp"

#include <regex>

namespace limber::bench {

std::string find_kind(const std::string& text) {
  static const std::regex names("(^|[ (])'[^']*'");
  static const std::regex numbers(
      "[-+]?([0-9][0-9.]*(e[-+]?[0-9]+)?|inf\\b|nan\\b)");
  static const std::regex breaks("\n");
  std::string kind = std::regex_replace(text, names, "$1");
  kind = std::regex_replace(kind, numbers, "");
  return std::regex_replace(kind, breaks, " ").substr(0, 72);
}

}  // namespace limber::bench
