// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <set>
#include <vector>

#include "limber/fem/nastran/bulk_card.hpp"
#include "limber/fem/structural/structure.hpp"

namespace limber::fem {

/// The nodes that cards name, as indices.
class NastranNodes {
 public:
  explicit NastranNodes(DeckProblems& problems) : problems_(&problems) {}
  void add(int id, int node) { nodes_[id] = node; }

  /// The node in a field; none, and at its first use a problem, if it is
  /// missing.
  [[nodiscard]] std::optional<int> find(const BulkCard& card,
                                        std::size_t field) const;
  /// Nodes from a field on, up to a real number or a word: numbers, and "3 THRU
  /// 7". @param field then the first that is not read
  [[nodiscard]] std::vector<int> read_list(const BulkCard& card,
                                           std::size_t& field) const;

 private:
  DeckProblems* problems_;
  std::map<int, int> nodes_;       // by number
  mutable std::set<int> missing_;  // told already
};

/// Adds an RBE2, an RBAR or an RBE3; a problem where it is not one that is
/// read: rigid in all components, or in translations where its nodes have no
/// others; means of translations that lead all six components.
/// @param turning nodes with rotations
void add_nastran_rigid(const BulkCard& card, const std::string& place,
                       const NastranNodes& nodes, const std::set<int>& turning,
                       DeckProblems& problems, Structure& structure);

}  // namespace limber::fem
