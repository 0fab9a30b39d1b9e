// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/abaqus/deck_attachments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "limber/common/echo.hpp"
#include "limber/common/upper_case.hpp"

namespace limber::fem {
namespace {

constexpr unsigned kAllThree = 0b111;

/// Of *BOUNDARY's named kinds; those of symmetry hold in part only.
unsigned find_named_mask(const std::string& name) {
  return name == "ENCASTRE" || name == "PINNED" ? kAllThree : 0;
}

}  // namespace

void require_isotropic_mass(const DeckPlace& at, const Keyword& keyword) {
  if (keyword.has("TYPE") && !keyword.get("TYPE").starts_with("ISO"))
    at.fail("*MASS has another TYPE. Expected the same mass along all axes.");
}

void DeckAttachments::add_data(const DeckPlace& at, const Keyword& keyword,
                               std::string_view line) {
  if (keyword.name == "MASS") {
    require_isotropic_mass(at, keyword);
    const std::string_view field = split_commas(line)[0];
    double mass = 0.0;
    if (!parse_real(field, mass) || !(mass >= 0.0))
      at.fail(
          fmt::format("*MASS is '{}'. Expected a number >= 0.", echo(field)));
    masses_.push_back({at.text(), keyword.get("ELSET"), mass});
  } else if (keyword.name == "BOUNDARY") {
    add_support(at, line);
  }
}

/// Node or set; first and last component, or the name of a kind.
void DeckAttachments::add_support(const DeckPlace& at, std::string_view line) {
  const std::vector<std::string_view> fields = split_commas(line);
  if (fields.size() < 2) return;
  Support support{to_upper(std::string(fields[0])), 0};
  long first = 0;
  if (!parse_whole(fields[1], first)) {
    support.mask = find_named_mask(to_upper(std::string(fields[1])));
  } else {
    long last = first;
    if (fields.size() > 2 && !fields[2].empty() &&
        !parse_whole(fields[2], last))
      at.fail(
          fmt::format("*BOUNDARY has the last component '{}'. Expected a "
                      "number.",
                      echo(fields[2])));
    for (long i = std::max(first, 1L); i <= std::min(last, 3L); ++i)
      support.mask |= 1U << static_cast<unsigned>(i - 1);
  }
  supports_.push_back(std::move(support));
}

std::set<long> DeckAttachments::find_held(const DeckSets& node_sets) const {
  std::map<long, unsigned> masks;
  for (const Support& support : supports_) {
    long node = 0;
    if (parse_whole(support.of, node)) masks[node] |= support.mask;
    for (const long number : node_sets.get(support.of))
      masks[number] |= support.mask;
  }
  std::set<long> held;
  for (const auto& [node, mask] : masks)
    if (mask == kAllThree) held.insert(node);
  return held;
}

}  // namespace limber::fem
