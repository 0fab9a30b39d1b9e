// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>

#include "limber/fem/mesh/mesh.hpp"
#include "limber/fem/nastran/bulk_card.hpp"
#include "limber/fem/nastran/grid_table.hpp"

namespace limber::fem {

/// MAT1, MAT9, MAT11, PSOLID and PARAM WTMASS of a deck. Format: MSC Nastran
/// Quick Reference Guide, "Bulk Data Entries".
class SolidMaterials {
 public:
  SolidMaterials(const Deck& deck, DeckProblems& problems)
      : deck_(&deck), problems_(&problems) {}

  /// @returns whether the card is one of them, or of temperatures (MATT)
  bool add(const BulkCard& card);

  /// In the deck's units; a problem in it, or no name, where it has none.
  /// @param grids complete
  [[nodiscard]] RegionMaterial find(int property, GridTable& grids) const;
  /// Of PARAM WTMASS [-].
  [[nodiscard]] double mass_factor() const { return mass_factor_; }

 private:
  struct Material {
    std::string name;  // as "MAT1 7"
    const DeckLine* line = nullptr;
    std::vector<std::optional<double>> fields;  // from the second on
  };
  struct Property {
    const DeckLine* line = nullptr;
    std::optional<int> material;
    int system = 0;  // of MAT9's axes; -1: of each element
  };

  void add_property(const BulkCard& card);
  void add_material(const BulkCard& card, std::size_t count);
  [[nodiscard]] std::string place_of(const DeckLine& line) const;
  [[nodiscard]] SolidMaterial convert(const Material& material,
                                      const Property& property,
                                      GridTable& grids) const;

  const Deck* deck_;
  DeckProblems* problems_;
  std::map<int, Material> materials_;
  std::map<int, Property> properties_;
  std::set<int> heated_;  // with MATT1, MATT9, ..
  double mass_factor_ = 1.0;
};

}  // namespace limber::fem
