// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "limber/fem/nastran/bulk_card.hpp"
#include "limber/fem/structural/laminate.hpp"

namespace limber::fem {

/// Materials of beams and shells in a Nastran deck.
/// Source: MSC Nastran Quick Reference Guide, MAT1, MAT2, MAT8
class NastranMaterials {
 public:
  explicit NastranMaterials(DeckProblems& problems) : problems_(&problems) {}

  struct Isotropic {
    double E = 0.0;
    double G = 0.0;
    double nu = 0.0;
    double density = 0.0;
  };

  /// @returns false for a card of another kind
  bool add(const BulkCard& card);

  /// The MAT1 in a property's field; none, and a problem, if it is missing.
  std::optional<Isotropic> find_isotropic(const BulkCard& card,
                                          std::size_t field);
  /// The MAT1 or MAT8 with this number.
  std::optional<PlyMaterial> find_ply(const BulkCard& card, int id,
                                      bool has_mass = true);
  /// The MAT1, MAT2 or MAT8 in a property's field.
  /// @param has_mass whether its density counts
  std::optional<PlyMaterial> find_plate(const BulkCard& card, std::size_t field,
                                        bool has_mass);

  /// What is to be told once: "MAT8 3: ..."
  [[nodiscard]] const std::vector<std::string>& notices() const {
    return notices_;
  }

 private:
  void add_isotropic(const BulkCard& card, int id);
  void add_plate(const BulkCard& card, int id);
  void add_ply(const BulkCard& card, int id);
  /// Numbers in `count` fields, 0 where blank; none, and a problem, if one is
  /// no number.
  std::optional<std::vector<double>> read_reals(const BulkCard& card,
                                                std::size_t first,
                                                std::size_t count);
  std::optional<Vector6> find_strengths(const BulkCard& card);
  /// A material that is not among those looked for: none, and a problem unless
  /// its own card has one.
  std::nullopt_t refuse_missing(const BulkCard& card, int id,
                                const char* expected);
  void note_density(int id, double density);
  bool require(bool fine, const BulkCard& card, const std::string& what);

  DeckProblems* problems_;
  std::map<int, Isotropic> isotropic_;
  std::map<int, PlyMaterial> plies_;
  std::map<int, PlyMaterial> plates_;
  std::set<int> numbers_;
  std::set<int> wrong_;  // their cards have a problem
  std::set<int> weightless_;
  std::vector<std::string> notices_;
};

}  // namespace limber::fem
