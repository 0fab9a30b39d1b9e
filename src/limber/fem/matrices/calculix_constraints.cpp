// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <unordered_map>

#include "limber/common/index.hpp"
#include "limber/fem/matrices/calculix_model.hpp"

namespace limber::fem {
namespace {

/// What a row is, as a sum of factors times rows of the matrices.
using RowSum = std::map<int, double>;

/// Node that CalculiX made for the rotations of each rigid body, in the order
/// of the file; none if other constraints make nodes, too.
std::vector<long> find_rotation_nodes(const InputDeck& deck) {
  long last = 0;
  for (const long tag : deck.model.tags) last = std::max(last, tag);
  std::vector<long> nodes;
  for (const DeckRigid& rigid : deck.rigids) {
    if (rigid.rotation != 0) {
      nodes.push_back(rigid.rotation);
    } else {
      nodes.push_back(deck.has_other_constraints ? 0 : ++last);
    }
  }
  return nodes;
}

class ConstraintSolver {
 public:
  ConstraintSolver(const InputDeck& deck, const std::vector<RowLabel>& rows,
                   MatrixModel& model)
      : deck_(&deck), model_(&model) {
    for (std::size_t i = 0; i < rows.size(); ++i)
      rows_[rows[i]] = static_cast<int>(i);
    for (std::size_t i = 0; i < model.tags.size(); ++i)
      nodes_[static_cast<long>(model.tags[i])] = static_cast<int>(i);
    for (const RowLabel& label : deck.fixed) rows_.try_emplace(label, -1);
  }

  void solve() {
    for (const DeckRigid& rigid : deck_->rigids) add_rigid(rigid);
    // An equation may use what another one gives.
    std::vector<const DeckEquation*> left;
    for (const DeckEquation& equation : deck_->equations)
      left.push_back(&equation);
    for (std::size_t before = left.size() + 1; left.size() < before;) {
      before = left.size();
      std::erase_if(left, [&](const DeckEquation* e) { return add(*e); });
    }
    for (const DeckEquation* equation : left)
      model_->found.push_back(
          fmt::format("{}: this equation has terms without rows; its dependent "
                      "term does not move.",
                      equation->place));
    store();
  }

 private:
  std::optional<RowSum> find(const RowLabel& label) const {
    const auto row = rows_.find(label);
    if (row != rows_.end())
      return row->second < 0 ? RowSum{} : RowSum{{row->second, 1.0}};
    const auto sum = sums_.find(label);
    if (sum != sums_.end()) return sum->second;
    return std::nullopt;
  }

  void add_rigid(const DeckRigid& rigid) {
    const auto reference = nodes_.find(rigid.reference);
    std::array<std::optional<RowSum>, 6> motion;
    bool is_whole = reference != nodes_.end();
    for (int i = 0; i < 6; ++i) {
      motion[index(i)] = find({rigid.reference, i + 1});
      is_whole = is_whole && motion[index(i)].has_value();
    }
    if (!is_whole) {
      model_->found.push_back(
          fmt::format("{}: the motion of reference node {} is not among the "
                      "rows; the nodes that follow it do not move.",
                      rigid.place, rigid.reference));
      return;
    }
    for (const long node : rigid.nodes) {
      const auto place = nodes_.find(node);
      if (place == nodes_.end() || node == rigid.reference) continue;
      const Vector3 d =
          model_->x.col(place->second) - model_->x.col(reference->second);
      for (int i = 0; i < 3; ++i) {
        const RowLabel label{node, i + 1};
        if (!rigid.translations[index(i)] || find(label)) continue;
        // u_i + (theta x d)_i
        RowSum sum = *motion[index(i)];
        const int j = (i + 1) % 3;
        const int k = (i + 2) % 3;
        for (const auto& [row, factor] : *motion[index(3 + j)])
          sum[row] += factor * d[k];
        for (const auto& [row, factor] : *motion[index(3 + k)])
          sum[row] -= factor * d[j];
        sums_[label] = std::move(sum);
      }
    }
  }

  bool add(const DeckEquation& equation) {
    const auto& [first, factor] = equation.terms[0];
    if (find(first)) return true;
    if (factor == 0.0) return false;
    RowSum sum;
    for (std::size_t i = 1; i < equation.terms.size(); ++i) {
      const auto& [label, other] = equation.terms[i];
      const std::optional<RowSum> part = find(label);
      if (!part) return false;
      for (const auto& [row, value] : *part) sum[row] -= other / factor * value;
    }
    sums_[first] = std::move(sum);
    return true;
  }

  void store() {
    std::vector<Eigen::Triplet<double>> triplets;
    for (const auto& [label, sum] : sums_) {
      const auto node = nodes_.find(label.node);
      if (node == nodes_.end()) continue;
      const auto row = static_cast<int>(model_->condensed.size());
      model_->condensed.push_back({node->second, label.component - 1});
      for (const auto& [column, value] : sum)
        triplets.emplace_back(row, column, value);
    }
    model_->equations.resize(
        static_cast<Eigen::Index>(model_->condensed.size()),
        static_cast<Eigen::Index>(model_->rows.size()));
    model_->equations.setFromTriplets(triplets.begin(), triplets.end());
  }

  const InputDeck* deck_;
  MatrixModel* model_;
  std::map<RowLabel, int> rows_;  // -1: fixed
  std::unordered_map<long, int> nodes_;
  std::map<RowLabel, RowSum> sums_;
};

}  // namespace

void name_rotations(const InputDeck& deck, std::vector<RowLabel>& rows) {
  const std::vector<long> rotations = find_rotation_nodes(deck);
  std::unordered_map<long, long> references;
  for (std::size_t i = 0; i < rotations.size(); ++i)
    if (rotations[i] != 0) references[rotations[i]] = deck.rigids[i].reference;
  for (RowLabel& row : rows) {
    const auto found = references.find(row.node);
    if (found != references.end() && row.component <= 3)
      row = {found->second, row.component + 3};
  }
}

void add_constraints(const InputDeck& deck, const std::vector<RowLabel>& rows,
                     MatrixModel& model) {
  ConstraintSolver(deck, rows, model).solve();
}

}  // namespace limber::fem
