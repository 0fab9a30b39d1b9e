// SPDX-License-Identifier: BSD-3-Clause
#include "flexbody/recipe.hpp"

namespace limber::flexbody {

KeptRows parse_rows(const std::vector<std::string>& words) {
  using Extent = KeptRows::Extent;
  if (words.size() == 1) {
    if (words[0] == "all") return {Extent::all, {}};
    if (words[0] == "boundary") return {Extent::boundary, {}};
    if (words[0] == "interfaces") return {Extent::groups, {}};
  }
  return {Extent::groups, words};
}

}  // namespace limber::flexbody
