// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "limber/common/types.hpp"
#include "limber/fem/text/deck_place.hpp"
#include "limber/fem/text/keyword_deck.hpp"

namespace limber::fem {

/// @throws InputError for a keyword whose parameter `key`, its name, is missing
void require_name(const DeckPlace& at, const Keyword& keyword,
                  const std::string& key);

/// @throws InputError with file and line unless it is an integer from 1
[[nodiscard]] long read_deck_number(const DeckPlace& at, std::string_view field,
                                    const char* what);

/// 0 of a blank field. @throws InputError with file and line unless it is a
/// finite number
[[nodiscard]] double read_deck_real(const DeckPlace& at,
                                    std::string_view field);

/// Coordinates of a line of *NODE, fields 2 to 4; 0 where they are blank or
/// absent. @throws InputError as read_deck_real
[[nodiscard]] Vector3 read_deck_point(
    const DeckPlace& at, const std::vector<std::string_view>& fields);

/// What is done with the entries of a set.
struct SetReading {
  std::function<void(long)> add_number;
  /// @param name in upper case @returns false if there is no such set
  std::function<bool(const std::string& name)> add_set;
};

/// Reads a data line of *NSET or *ELSET: numbers, names of sets before it, or
/// with GENERATE first, last and step.
/// @throws InputError with file and line
void read_set_line(const DeckPlace& at, const Keyword& keyword,
                   std::string_view line, const SetReading& reading);

/// Sets of numbers of nodes or of elements, by their names in upper case.
class DeckSets {
 public:
  /// Adds a data line. @throws InputError as read_set_line
  void add_line(const DeckPlace& at, const Keyword& keyword,
                const std::string& name, std::string_view line);
  void add(const std::string& name, long number) {
    if (!name.empty()) sets_[name].push_back(number);
  }

  [[nodiscard]] const std::map<std::string, std::vector<long>>& all() const {
    return sets_;
  }
  /// Empty without it.
  [[nodiscard]] std::vector<long> get(const std::string& name) const;

 private:
  std::map<std::string, std::vector<long>> sets_;
};

}  // namespace limber::fem
