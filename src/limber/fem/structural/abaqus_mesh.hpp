// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "limber/common/types.hpp"
#include "limber/fem/abaqus/solid_type.hpp"
#include "limber/fem/text/deck_sets.hpp"

namespace limber::fem {

struct InputElement {
  std::string type;
  const SolidType* solid = nullptr;  ///< null: a beam, a shell or a mass
  std::vector<int> nodes;            ///< numbers, then indices
  std::string place;                 ///< "file:line"
};

/// Nodes and elements of an input file with beams and shells.
struct AbaqusMesh {
  std::map<long, int> nodes;  ///< indices by number
  Matrix3X x;                 ///< 3 x nodes
  std::map<long, InputElement> elements;
  DeckSets node_sets;
  DeckSets element_sets;

  /// @param place of what names them, for messages
  /// @throws InputError where there is none
  [[nodiscard]] int find_node(long number, const std::string& place) const;
  /// Of a set, or one by its number, in upper case; each once.
  [[nodiscard]] std::vector<int> find_nodes(const std::string& of,
                                            const std::string& place) const;
  [[nodiscard]] std::set<long> list_elements(const std::string& of,
                                             const std::string& place) const;
  [[nodiscard]] std::vector<const InputElement*> find_elements(
      const std::string& of, const std::string& place) const;
  /// Axis 1 of a shell without an orientation, before its projection: x, or z
  /// where x is within 0.1 degrees of the normal (Abaqus' convention).
  [[nodiscard]] Vector3 find_default_axis(const InputElement& element) const;
  /// @throws InputError for an element of the set that is no solid
  void require_solids(const std::string& elset, const std::string& place) const;
};

}  // namespace limber::fem
