// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/piece_names.hpp"

namespace limber {

std::string name_piece(const std::string& link, int piece) {
  return link + "." + std::to_string(piece + 1);
}

std::string find_whole(const std::string& body) {
  const std::size_t dot = body.rfind('.');
  const bool is_piece =
      dot != std::string::npos && dot > 0 && dot + 1 < body.size() &&
      body.find_first_not_of("0123456789", dot + 1) == std::string::npos;
  return is_piece ? body.substr(0, dot) : body;
}

}  // namespace limber
