// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/model/recipe.hpp"

#include <algorithm>
#include <cstddef>

#include "limber/common/errors.hpp"
#include "limber/common/names.hpp"

namespace limber::flexbody {
namespace {

const std::vector<std::string>& measure_names() {
  static const std::vector<std::string> names = {"compliance", "report",
                                                 "mass"};
  return names;
}

}  // namespace

std::string_view to_string(ModeMeasure measure) {
  return measure_names()[static_cast<std::size_t>(measure)];
}

ModeMeasure parse_measure(std::string_view name) {
  return static_cast<ModeMeasure>(find_name("measure", name, measure_names()));
}

KeptRows parse_rows(const std::vector<std::string>& names) {
  using Extent = KeptRows::Extent;
  if (names.size() == 1) {
    if (names[0] == "all") return {Extent::all, {}};
    if (names[0] == "boundary") return {Extent::boundary, {}};
    if (names[0] == "interfaces") return {Extent::groups, {}};
  }
  return {Extent::groups, names};
}

}  // namespace limber::flexbody
