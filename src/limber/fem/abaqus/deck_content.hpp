// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "limber/common/types.hpp"
#include "limber/fem/abaqus/deck_attachments.hpp"
#include "limber/fem/abaqus/deck_counts.hpp"
#include "limber/fem/abaqus/deck_materials.hpp"
#include "limber/fem/abaqus/solid_type.hpp"
#include "limber/fem/mesh/solid_deck.hpp"
#include "limber/fem/text/deck_sets.hpp"

namespace limber::fem {

struct DeckElement {
  std::size_t number = 0;
  std::string_view type = {};        ///< into DeckContent::types
  const SolidType* solid = nullptr;  ///< null: another kind
  Tags nodes;                        ///< as the file has them
  std::size_t file = 0;              ///< into DeckContent::files
  std::size_t line = 0;
};

struct DeckSurfacePart {
  std::string place = {};  ///< "file:line"
  std::string of = {};     ///< a set, or an element's number
  int face = 0;            ///< from 1
};

/// What an input file says of a mesh, by its numbers and names.
struct DeckContent {
  std::vector<std::filesystem::path> files;
  std::map<std::size_t, Vector3> nodes;
  std::vector<DeckElement> elements;
  std::unordered_map<std::size_t, std::size_t> index;  ///< into elements
  std::set<std::string> types;
  DeckSets node_sets;
  DeckSets element_sets;
  std::vector<Keyword> nodes_of;  ///< *NSET with ELSET
  std::map<std::string, std::vector<DeckSurfacePart>> surfaces;
  DeckMaterials materials;
  DeckAttachments attachments;
  /// Names of sets and surfaces, which are in upper case, as first written.
  std::map<std::string, std::string> spelling;
  std::map<std::string, std::string> places;  ///< of *NSET, *ELSET by name
  DeckCounts constraints;  ///< contact, and keywords that are not known
  DeckCounts unused;       ///< supports, loads
  DeckCounts laws;         ///< of materials, beside linear elasticity
  std::vector<std::string> notices;

  /// Null without it.
  [[nodiscard]] const DeckElement* find(long number) const;
  /// Of a set, or one by its number.
  [[nodiscard]] std::vector<long> find_elements(const std::string& name) const;
  [[nodiscard]] std::string spell(const std::string& name) const;
  /// "file:line"
  [[nodiscard]] std::string place_of(const DeckElement& element) const;
};

/// @throws InputError with file and line
[[nodiscard]] DeckContent read_deck_content(const std::filesystem::path& file);

}  // namespace limber::fem
