// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/newton/block_lu.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"

namespace limber::dynamics {
namespace {

using Graph = std::vector<std::set<int>>;

// Removes the vertex of least degree, early ones first, joins its neighbours,
// and so on.
// @returns for each pivot in order its row and its neighbours when removed.
std::vector<std::pair<int, std::vector<int>>> eliminate(Graph graph,
                                                        int first_preceding) {
  std::set<std::pair<std::size_t, int>> by_degree;
  const auto rank = [&](int i) {
    const std::size_t degree = graph[index(i)].size();
    return std::pair(i < first_preceding ? graph.size() + degree : degree, i);
  };
  for (int i = 0; i < static_cast<int>(graph.size()); ++i) {
    by_degree.insert(rank(i));
  }
  std::vector<std::pair<int, std::vector<int>>> order;
  while (!by_degree.empty()) {
    const int row = by_degree.begin()->second;
    by_degree.erase(by_degree.begin());
    const std::vector<int> neighbours(graph[index(row)].begin(),
                                      graph[index(row)].end());
    for (const int i : neighbours) {
      std::set<int>& links = graph[index(i)];
      by_degree.erase(rank(i));
      links.erase(row);
      links.insert(neighbours.begin(), neighbours.end());
      links.erase(i);
      by_degree.insert(rank(i));
    }
    order.emplace_back(row, neighbours);
  }
  return order;
}

}  // namespace

BlockLu::BlockLu(int size, const std::vector<std::pair<int, int>>& edges,
                 int first_preceding)
    : index_(index(size)) {
  std::vector<std::map<int, int>> found(index(size));
  int count = 0;
  const auto find_or_add = [&](int row, int column) {
    const auto [entry, is_new] = found[index(row)].emplace(column, count);
    if (is_new) ++count;
    return entry->second;
  };
  Graph graph(index(size));
  for (const auto& [i, j] : edges) {
    LIMBER_EXPECT(i >= 0 && j >= 0 && i < size && j < size && i != j);
    graph[index(i)].insert(j);
    graph[index(j)].insert(i);
  }
  // Diagonal blocks are the first, in the order of rows.
  for (int i = 0; i < size; ++i) find_or_add(i, i);
  for (auto& [row, neighbours] : eliminate(graph, first_preceding)) {
    Pivot pivot{.row = row,
                .rows = neighbours,
                .lower = {},
                .upper = {},
                .updates = {}};
    for (const int i : neighbours) {
      pivot.lower.push_back(find_or_add(i, row));
      pivot.upper.push_back(find_or_add(row, i));
    }
    for (std::size_t i = 0; i < neighbours.size(); ++i) {
      for (std::size_t j = 0; j < neighbours.size(); ++j) {
        pivot.updates.push_back({pivot.lower[i], pivot.upper[j],
                                 find_or_add(neighbours[i], neighbours[j])});
      }
    }
    pivots_.push_back(std::move(pivot));
  }
  blocks_.resize(index(count));
  inverses_.resize(index(size));
  for (std::size_t row = 0; row < found.size(); ++row) {
    index_[row].assign(found[row].begin(), found[row].end());
  }
  set_zero();
}

void BlockLu::set_zero() {
  for (Matrix6& block : blocks_) block.setZero();
}

Matrix6& BlockLu::block(int row, int column) {
  const Row& entries = index_[index(row)];
  const auto entry = std::lower_bound(entries.begin(), entries.end(),
                                      std::pair<int, int>(column, 0));
  if (entry != entries.end() && entry->first == column) {
    return blocks_[index(entry->second)];
  }
  throw ContractError("BlockLu: no such block in the pattern");
}

void BlockLu::scale_row(int row, const Matrix6& factor) {
  for (const auto& [column, block] : index_[index(row)]) {
    const Matrix6 product = factor * blocks_[index(block)];
    blocks_[index(block)] = product;
  }
}

std::optional<int> BlockLu::factor() {
  for (const Pivot& pivot : pivots_) {
    const std::size_t row = index(pivot.row);
    inverses_[row] = blocks_[row].inverse();
    if (!inverses_[row].allFinite()) return pivot.row;
    for (const int lower : pivot.lower) {
      const Matrix6 product = blocks_[index(lower)] * inverses_[row];
      blocks_[index(lower)] = product;
    }
    for (const Update& u : pivot.updates) {
      blocks_[index(u.target)].noalias() -=
          blocks_[index(u.lower)] * blocks_[index(u.upper)];
    }
  }
  return std::nullopt;
}

void BlockLu::solve(std::vector<Vector6>& x) const {
  for (const Pivot& pivot : pivots_) {
    for (std::size_t i = 0; i < pivot.rows.size(); ++i) {
      x[index(pivot.rows[i])].noalias() -=
          blocks_[index(pivot.lower[i])] * x[index(pivot.row)];
    }
  }
  for (auto pivot = pivots_.rbegin(); pivot != pivots_.rend(); ++pivot) {
    Vector6 sum = x[index(pivot->row)];
    for (std::size_t i = 0; i < pivot->rows.size(); ++i) {
      sum.noalias() -=
          blocks_[index(pivot->upper[i])] * x[index(pivot->rows[i])];
    }
    x[index(pivot->row)].noalias() = inverses_[index(pivot->row)] * sum;
  }
}

}  // namespace limber::dynamics
