// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "limber/fem/text/deck_sets.hpp"

namespace limber::fem {

/// *MASS: of each element of a set.
struct DeckMass {
  std::string place;  ///< "file:line"
  std::string elset;
  double mass = 0.0;  ///< >= 0 [deck units]
};

/// @throws InputError for a *MASS that differs by axes
void require_isotropic_mass(const DeckPlace& at, const Keyword& keyword);

/// *MASS and *BOUNDARY of an input file.
class DeckAttachments {
 public:
  /// @throws InputError with file and line
  void add_data(const DeckPlace& at, const Keyword& keyword,
                std::string_view line);

  [[nodiscard]] const std::vector<DeckMass>& masses() const { return masses_; }
  /// Nodes that are held in 1, 2 and 3.
  [[nodiscard]] std::set<long> find_held(const DeckSets& node_sets) const;

 private:
  struct Support {
    std::string of;     // a set of nodes, or a node's number
    unsigned mask = 0;  // bit i: component i + 1, of the first three
  };
  void add_support(const DeckPlace& at, std::string_view line);

  std::vector<DeckMass> masses_;
  std::vector<Support> supports_;
};

}  // namespace limber::fem
