// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/abaqus/deck_sets.hpp"

#include <fmt/format.h>

#include "limber/common/echo.hpp"
#include "limber/common/upper_case.hpp"

namespace limber::fem {

long read_deck_number(const TextScanner& at, std::string_view field,
                      const char* what) {
  constexpr long kMost = 2'000'000'000;
  long value = 0;
  if (!parse_whole(field, value) || value < 1 || value > kMost)
    at.fail(fmt::format("'{}' is no {}. Expected an integer from 1.",
                        echo(field), what));
  return value;
}

void DeckSets::generate(const TextScanner& at,
                        const std::vector<std::string_view>& of,
                        std::vector<long>& out) const {
  constexpr long kMost = 20'000'000;
  const long first = read_deck_number(at, of[0], "number");
  const long last =
      of.size() > 1 ? read_deck_number(at, of[1], "number") : first;
  const long step =
      of.size() > 2 && !of[2].empty() ? read_deck_number(at, of[2], "step") : 1;
  if (last < first || (last - first) / step > kMost)
    at.fail("GENERATE gives no set. Expected first, last and step.");
  for (long number = first; number <= last; number += step)
    out.push_back(number);
}

void DeckSets::add_line(const TextScanner& at, const Keyword& keyword,
                        const std::string& name, std::string_view line) {
  const std::vector<std::string_view> fields = split_commas(line);
  std::vector<long>& set = sets_[name];
  if (keyword.has("GENERATE")) return generate(at, fields, set);
  for (const std::string_view field : fields) {
    if (field.empty()) continue;
    long number = 0;
    if (parse_whole(field, number)) {
      set.push_back(number);
      continue;
    }
    const auto other = sets_.find(to_upper(std::string(field)));
    if (other == sets_.end())
      at.fail(fmt::format("*{} names the set {}. Expected it before this line.",
                          echo(keyword.name), echo(field)));
    const std::vector<long> copy = other->second;
    set.insert(set.end(), copy.begin(), copy.end());
  }
}

std::vector<long> DeckSets::get(const std::string& name) const {
  const auto found = sets_.find(name);
  return found == sets_.end() ? std::vector<long>() : found->second;
}

}  // namespace limber::fem
