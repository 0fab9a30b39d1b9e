// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <set>

#include "limber/fem/nastran/bulk_card.hpp"
#include "limber/fem/structural/nastran_materials.hpp"
#include "limber/fem/structural/structure.hpp"

namespace limber::fem {

/// Properties of beams and shells in a Nastran deck, with their materials.
/// Source: MSC Nastran Quick Reference Guide, PBAR, PBARL, PBEAM, PBEAML,
/// PSHELL, PCOMP
class NastranProperties {
 public:
  explicit NastranProperties(DeckProblems& problems)
      : problems_(&problems), materials_(problems) {}

  /// @returns false for a card of another kind
  bool add(const BulkCard& card);

  /// A CBAR or CBEAM with what BAROR or BEAMOR give where it is blank.
  [[nodiscard]] BulkCard fill_bar(BulkCard card) const;

  /// By a property's number; none, and a problem, if it is missing or wrong.
  /// @param user the element's line
  std::optional<BeamProperty> find_beam(int id, const DeckLine& user);
  std::optional<Laminate> find_shell(int id, const DeckLine& user);

  /// What is to be told once: "PBEAM 3: ..."
  [[nodiscard]] std::vector<std::string> notices() const;

 private:
  std::optional<BeamProperty> make_bar(const BulkCard& card);
  std::optional<BeamProperty> make_tapered(const BulkCard& card);
  std::optional<BeamProperty> make_library(const BulkCard& card);
  std::optional<Laminate> make_plate(const BulkCard& card);
  std::optional<Laminate> make_stack(const BulkCard& card);
  double real(const BulkCard& card, std::size_t field);
  bool require(bool fine, const BulkCard& card, const std::string& what);

  DeckProblems* problems_;
  NastranMaterials materials_;
  std::map<int, BulkCard> cards_;                  // of properties
  std::set<int> missing_;                          // told already
  std::map<std::string_view, BulkCard> defaults_;  // by the name of bars
  std::map<int, std::optional<BeamProperty>> beams_;
  std::map<int, std::optional<Laminate>> shells_;
  std::vector<std::string> notices_;
};

}  // namespace limber::fem
