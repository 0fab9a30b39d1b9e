// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>
#include <utility>

namespace limber::dynamics {

/// Names of a system's objects, unique per kind.
class NameRegister {
 public:
  /// "KIND 'NAME'", for errors.
  /// @throws InputError for a name that is empty, already used or invalid: not
  /// UTF-8, with a control character, or longer than kMostNameBytes.
  [[nodiscard]] std::string check(const std::string& kind,
                                  const std::string& name) const;
  void add(const std::string& kind, const std::string& name) {
    taken_.emplace(kind, name);
  }

 private:
  std::set<std::pair<std::string, std::string>> taken_;
};

}  // namespace limber::dynamics
