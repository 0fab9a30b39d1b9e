// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "limber/fem/mesh/solid_deck.hpp"
#include "limber/fem/nastran/solid_card.hpp"

namespace limber::fem {

/// Mid-side nodes of a deck's elements by their edge, to fill blank ones.
class MidSideNodes {
 public:
  /// @param nodes of an element of second order in Nastran's order; 0: blank
  /// @param first of its nodes, an index into the nodes of its block
  /// @param name of the element, for notices
  void add(const SolidCard& solid, const std::vector<std::size_t>& nodes,
           std::size_t first, const std::string& name);

  /// Puts into each blank place the node that other elements have on this edge,
  /// or else a new one in its middle, with a number above all others.
  /// @returns notices
  [[nodiscard]] std::vector<std::string> fill(const std::string& source,
                                              SolidDeck& deck) const;

 private:
  using Edge = std::pair<std::size_t, std::size_t>;  // corners, ascending

  struct Blank {
    int type = 0;           // Gmsh's, of its block
    std::size_t place = 0;  // index into the nodes of its block
    Edge edge;
    std::string name;
  };

  std::map<Edge, std::size_t> nodes_;
  std::vector<Blank> blanks_;
};

}  // namespace limber::fem
