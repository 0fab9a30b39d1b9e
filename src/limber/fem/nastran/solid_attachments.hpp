// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <set>
#include <string>
#include <unordered_set>
#include <vector>

#include "limber/fem/mesh/solid_deck.hpp"
#include "limber/fem/nastran/bulk_card.hpp"

namespace limber::fem {

/// What a deck attaches to its solids: CONM2 as point masses; the nodes of RBE2
/// and RBE3, and those that SPC and SPC1 hold, as named sets. Format: MSC
/// Nastran Quick Reference Guide, "Bulk Data Entries".
class SolidAttachments {
 public:
  explicit SolidAttachments(DeckProblems& problems) : problems_(&problems) {}

  /// @returns whether the card is one of them
  bool add(const BulkCard& card);

  /// Adds masses, groups rbe2:EID, rbe3:EID and spc:SID, and notices.
  /// @param solid numbers of the nodes of solids
  /// @param mass_factor of PARAM WTMASS [-]
  void resolve(const std::unordered_set<int>& solid, double mass_factor,
               SolidDeck& deck);

 private:
  void add_mass(const BulkCard& card, double mass_factor, SolidDeck& deck);
  void add_spider(const BulkCard& card, SolidDeck& deck);
  void add_support(const BulkCard& card);
  [[nodiscard]] std::vector<int> read_spider_nodes(const BulkCard& card) const;
  /// Numbers, and "3 THRU 7", from a field to one that is a word or a real.
  [[nodiscard]] std::vector<int> read_nodes(const BulkCard& card,
                                            std::size_t& field) const;
  void require_solid(const BulkCard& card, const std::vector<int>& nodes) const;
  [[nodiscard]] bool is_solid(int node) const { return solid_.contains(node); }

  DeckProblems* problems_;
  std::vector<BulkCard> masses_, spiders_, supports_;
  std::unordered_set<int> solid_;
  std::map<int, std::string> hubs_;            // of spiders, by node
  std::map<std::string, std::set<int>> held_;  // by name
};

}  // namespace limber::fem
