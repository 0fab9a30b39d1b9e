// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>

#include "limber/fem/nastran/bulk_card.hpp"
#include "limber/fem/structural/structure.hpp"

namespace limber::fem {

/// Materials and properties of beams and shells in a Nastran deck.
/// Source: MSC Nastran Quick Reference Guide, MAT1, MAT8, PBAR, PBARL, PBEAM,
/// PBEAML, PSHELL, PCOMP
class NastranProperties {
 public:
  explicit NastranProperties(DeckProblems& problems) : problems_(&problems) {}

  /// @returns false for a card of another kind
  bool add(const BulkCard& card);

  /// By a property's number; none, and a problem, if it is missing or wrong.
  /// @param user the element's line
  std::optional<BeamProperty> find_beam(int id, const DeckLine& user);
  std::optional<Laminate> find_shell(int id, const DeckLine& user);

  /// What is to be told once: "PBEAM 3: ..."
  [[nodiscard]] const std::vector<std::string>& notices() const {
    return notices_;
  }

 private:
  struct Isotropic {
    double E = 0.0;
    double G = 0.0;
    double nu = 0.0;
    double density = 0.0;
  };

  void add_isotropic(const BulkCard& card);
  void add_ply_material(const BulkCard& card);
  Vector6 find_strengths(const BulkCard& card);
  std::optional<Isotropic> find_isotropic(const BulkCard& card,
                                          std::size_t field);
  std::optional<PlyMaterial> find_ply_material(const BulkCard& card, int id);
  std::optional<BeamProperty> make_bar(const BulkCard& card);
  std::optional<BeamProperty> make_tapered(const BulkCard& card);
  std::optional<BeamProperty> make_library(const BulkCard& card);
  std::optional<Laminate> make_plate(const BulkCard& card);
  std::optional<Laminate> make_stack(const BulkCard& card);
  double real(const BulkCard& card, std::size_t field);
  bool require(bool fine, const BulkCard& card, const std::string& what);

  DeckProblems* problems_;
  std::map<int, Isotropic> isotropic_;
  std::map<int, PlyMaterial> plies_;
  std::map<int, BulkCard> cards_;  // of properties
  std::map<int, std::optional<BeamProperty>> beams_;
  std::map<int, std::optional<Laminate>> shells_;
  std::vector<std::string> notices_;
};

}  // namespace limber::fem
