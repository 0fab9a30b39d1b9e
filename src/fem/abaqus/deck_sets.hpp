// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "limber/fem/text/keyword_deck.hpp"

namespace limber::fem {

/// Sets of numbers of nodes or of elements, by their names in upper case.
class DeckSets {
 public:
  /// Adds a data line of *NSET or *ELSET: numbers, names of sets before it, or
  /// with GENERATE first, last and step.
  /// @throws InputError with file and line
  void add_line(const TextScanner& at, const Keyword& keyword,
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
  void generate(const TextScanner& at, const std::vector<std::string_view>& of,
                std::vector<long>& out) const;

  std::map<std::string, std::vector<long>> sets_;
};

/// @throws InputError with file and line unless it is an integer from 1
[[nodiscard]] long read_deck_number(const TextScanner& at,
                                    std::string_view field, const char* what);

}  // namespace limber::fem
