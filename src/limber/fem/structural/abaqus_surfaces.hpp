// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "limber/fem/structural/abaqus_mesh.hpp"
#include "limber/fem/text/deck_place.hpp"
#include "limber/fem/text/keyword_deck.hpp"

namespace limber::fem {

/// *SURFACE of an input file: of nodes, and of faces of solids (S1, ...), faces
/// (SPOS, SNEG) and edges (E1, ...) of shells.
class AbaqusSurfaces {
 public:
  void begin(const DeckPlace& at, const Keyword& keyword);
  void add_data(const DeckPlace& at, std::string_view line);

  /// Nodes with the area or length that is theirs, int N dA; 1 each of a
  /// surface of nodes. Sides are taken as straight.
  /// @throws InputError with the place of what is missing or not read
  [[nodiscard]] std::map<int, double> find_weights(
      const AbaqusMesh& mesh, const std::string& name,
      const std::string& place) const;

 private:
  struct Part {
    std::string place;
    std::string of;    ///< a set, or a number
    std::string face;  ///< empty: of nodes
  };

  std::string name_;  // that lines belong to
  bool is_of_nodes_ = false;
  std::map<std::string, std::vector<Part>> surfaces_;
};

}  // namespace limber::fem
