// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/sections/element_parts.hpp"

#include <fmt/format.h>

#include <map>
#include <utility>

#include "limber/common/errors.hpp"

namespace limber::fem {

const std::vector<std::vector<int>>& list_element_parts(
    const ReferenceElement& element, const std::string& place) {
  using Parts = std::vector<std::vector<int>>;
  // By corners and nodes, in Gmsh's order.
  static const std::map<std::pair<int, int>, Parts> known = {
      {{2, 2}, {{0, 1}}},
      {{2, 3}, {{0, 2}, {2, 1}}},
      {{3, 3}, {{0, 1, 2}}},
      {{3, 6}, {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}}},
      {{4, 4}, {{0, 1, 2, 3}}},
      {{4, 9}, {{0, 4, 8, 7}, {4, 1, 5, 8}, {8, 5, 2, 6}, {7, 8, 6, 3}}}};
  const auto found = known.find({element.corner_count, element.node_count});
  if (found != known.end() && element.order <= 2) return found->second;
  throw InputError(fmt::format(
      "{}: a {} becomes no beam or shell. Expected elements of first order, or "
      "of second order with a node in the middle of quadrilaterals "
      "(Mesh.SecondOrderIncomplete = 0).",
      place, element.name));
}

}  // namespace limber::fem
