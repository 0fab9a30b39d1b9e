// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/text/deck_sets.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "limber/common/echo.hpp"
#include "limber/common/upper_case.hpp"

namespace limber::fem {
namespace {

void generate(const DeckPlace& at, const std::vector<std::string_view>& fields,
              const SetReading& reading) {
  constexpr long kMost = 20'000'000;
  const long first = read_deck_number(at, fields[0], "number");
  const long last =
      fields.size() > 1 ? read_deck_number(at, fields[1], "number") : first;
  const long step = fields.size() > 2 && !fields[2].empty()
                        ? read_deck_number(at, fields[2], "step")
                        : 1;
  if (last < first || (last - first) / step > kMost)
    at.fail("GENERATE gives no set. Expected first, last and step.");
  for (long number = first; number <= last; number += step)
    reading.add_number(number);
}

}  // namespace

void require_name(const DeckPlace& at, const Keyword& keyword,
                  const std::string& key) {
  if (keyword.get(key).empty())
    at.fail(
        fmt::format("*{} has no name. Expected {}=NAME.", keyword.name, key));
}

long read_deck_number(const DeckPlace& at, std::string_view field,
                      const char* what) {
  constexpr long kMost = 2'000'000'000;
  long value = 0;
  if (!parse_whole(field, value) || value < 1 || value > kMost)
    at.fail(fmt::format("'{}' is no {}. Expected an integer from 1.",
                        echo(field), what));
  return value;
}

double read_deck_real(const DeckPlace& at, std::string_view field) {
  double value = 0.0;
  if (!field.empty() && !parse_real(field, value))
    at.fail(
        fmt::format("'{}' is no finite number. Expected one.", echo(field)));
  return value;
}

Vector3 read_deck_point(const DeckPlace& at,
                        const std::vector<std::string_view>& fields) {
  Vector3 x = Vector3::Zero();
  for (std::size_t i = 1; i < std::min<std::size_t>(fields.size(), 4); ++i)
    x[static_cast<Eigen::Index>(i) - 1] = read_deck_real(at, fields[i]);
  return x;
}

void read_set_line(const DeckPlace& at, const Keyword& keyword,
                   std::string_view line, const SetReading& reading) {
  const std::vector<std::string_view> fields = split_commas(line);
  if (keyword.has("GENERATE")) return generate(at, fields, reading);
  for (const std::string_view field : fields) {
    if (field.empty()) continue;
    long number = 0;
    if (parse_whole(field, number)) {
      reading.add_number(number);
    } else if (!reading.add_set(to_upper(std::string(field)))) {
      at.fail(fmt::format("*{} names the set {}. Expected it before this line.",
                          echo(keyword.name), echo(field)));
    }
  }
}

void DeckSets::add_line(const DeckPlace& at, const Keyword& keyword,
                        const std::string& name, std::string_view line) {
  std::vector<long>& set = sets_[name];
  read_set_line(at, keyword, line,
                {[&set](long number) { set.push_back(number); },
                 [&](const std::string& other) {
                   const std::vector<long> copy = get(other);
                   set.insert(set.end(), copy.begin(), copy.end());
                   return sets_.contains(other);
                 }});
}

std::vector<long> DeckSets::get(const std::string& name) const {
  const auto found = sets_.find(name);
  return found == sets_.end() ? std::vector<long>() : found->second;
}

}  // namespace limber::fem
