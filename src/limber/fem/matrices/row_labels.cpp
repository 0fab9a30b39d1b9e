// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/matrices/row_labels.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"

namespace limber::fem {
namespace {

using LabelledMatrix = Eigen::SparseMatrix<double>;

/// Components of a node's rows that are numbered alone, 3 or 6; 0: neither.
int find_components(std::size_t rows, std::size_t nodes) {
  if (nodes == 0) return 0;
  if (rows == 3 * nodes) return 3;
  if (rows == 6 * nodes) return 6;
  return 0;
}

void append_node(long node, int components, std::vector<RowLabel>& labels) {
  for (int c = 1; c <= components; ++c) labels.push_back({node, c});
}

/// CalculiX writes every diagonal entry, also zeros.
void check_diagonal(const SourceMatrix& source,
                    const std::vector<RowLabel>& labels) {
  const LabelledMatrix& A = source.matrix.entries;
  const auto rows = static_cast<int>(labels.size());
  for (int j = 0; j < rows; ++j) {
    bool is_there = false;
    if (j < A.outerSize())
      for (LabelledMatrix::InnerIterator it(A, j); it && it.row() <= j; ++it)
        is_there = it.row() == j;
    if (is_there) continue;
    throw InputError(fmt::format(
        "{}: entry ({}, {}) of row {} is missing. Expected every diagonal "
        "entry: is the file truncated?",
        source.matrix.file, j + 1, j + 1, name_row(labels[index(j)])));
  }
}

void label_by_table(const FileSet& set, std::size_t rows,
                    SourceMatrix& source) {
  const RowTable* found = nullptr;
  for (const RowTable& table : set.row_tables) {
    if (table.labels.size() != rows) continue;
    if (found != nullptr)
      throw InputError(fmt::format(
          "{}: {} and {} both have {} rows. "
          "Expected one table of that size.",
          set.source, found->file.string(), table.file.string(), rows));
    found = &table;
  }
  if (found == nullptr) {
    std::vector<std::string> sizes;
    for (const RowTable& table : set.row_tables)
      sizes.push_back(
          fmt::format("{} {}", table.file.string(), table.labels.size()));
    throw InputError(fmt::format(
        "{}: it has {} rows, and {}. Expected as many: is one of the files "
        "truncated?",
        source.matrix.file, rows, fmt::join(sizes, ", ")));
  }
  if (set.is_calculix) check_diagonal(source, found->labels);
  source.labels = found->labels;
}

void label_by_map(const FileSet& set, std::size_t rows, SourceMatrix& source) {
  const int components = find_components(rows, set.node_map.size());
  if (components == 0)
    throw InputError(fmt::format(
        "{}: it has {} rows, and the map of nodes {} blocks. Expected 3 or "
        "6 rows a block.",
        source.matrix.file, rows, set.node_map.size()));
  for (const long node : set.node_map)
    append_node(node, components, source.labels);
}

bool has_own_components(const ModelFile& nodes) {
  return !nodes.components.empty() && nodes.components[0] != 0;
}

std::vector<RowLabel> list_components(const ModelFile& nodes) {
  std::vector<RowLabel> labels;
  for (std::size_t i = 0; i < nodes.tags.size(); ++i)
    for (const char digit : std::to_string(nodes.components[i]))
      labels.push_back({nodes.tags[i], digit - '0'});
  return labels;
}

void label_by_nodes(FileSet& set, std::size_t rows, SourceMatrix& source) {
  if (!set.nodes)
    throw InputError(fmt::format(
        "{}: no nodes. Found: {}. Expected the positions of the nodes, and "
        "which node and component each of the {} rows is.",
        set.source, list_found(set), rows));
  const ModelFile& nodes = *set.nodes;
  const bool has_components = has_own_components(nodes);
  if (has_components) {
    source.labels = list_components(nodes);
  } else {
    const int components = find_components(rows, nodes.tags.size());
    // A table has its own order; programs number by ascending nodes.
    std::vector<long> order = nodes.tags;
    if (nodes.components.empty()) std::sort(order.begin(), order.end());
    for (const long node : order) append_node(node, components, source.labels);
    if (components != 0 && source.role != MatrixRole::mass)
      set.found.push_back(fmt::format(
          "rows: {} a node, in the order of {}", components,
          nodes.components.empty() ? "ascending numbers"
                                   : nodes.file.filename().string()));
  }
  if (source.labels.size() != rows)
    throw InputError(fmt::format(
        "{}: it has {} rows, and {} {} nodes{}. Expected a table of rows "
        "(row, node, component), or 3 or 6 rows for each node.",
        source.matrix.file, rows, nodes.file.string(), nodes.tags.size(),
        has_components
            ? fmt::format(" with {} components", source.labels.size())
            : std::string()));
}

}  // namespace

void check_twice(const SourceMatrix& source) {
  std::vector<std::size_t> order(source.labels.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(source.labels[a], a) < std::pair(source.labels[b], b);
  });
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (source.labels[order[i]] != source.labels[order[i - 1]]) continue;
    throw InputError(fmt::format(
        "{}: rows {} and {} are both {}. Expected each node's component "
        "once.",
        source.matrix.file, order[i - 1] + 1, order[i] + 1,
        name_row(source.labels[order[i]])));
  }
}

void label_by_points(const ModelFile& points, SourceMatrix& recovery) {
  if (has_own_components(points)) {
    recovery.labels = list_components(points);
    return;
  }
  const auto rows = static_cast<std::size_t>(recovery.matrix.entries.rows());
  const int components = find_components(rows, points.tags.size());
  for (const long point : points.tags)
    append_node(point, components, recovery.labels);
}

std::string list_found(const FileSet& set) {
  std::vector<std::string> all;
  for (const SourceMatrix& source : set.matrices)
    all.push_back(describe_matrix(source));
  all.insert(all.end(), set.found.begin(), set.found.end());
  return all.empty() ? "nothing" : fmt::format("{}", fmt::join(all, "; "));
}

void label_rows(FileSet& set, Eigen::Index rows, SourceMatrix& source) {
  const auto count = static_cast<std::size_t>(rows);
  if (!set.row_tables.empty()) {
    label_by_table(set, count, source);
  } else if (!set.node_map.empty()) {
    label_by_map(set, count, source);
  } else {
    label_by_nodes(set, count, source);
  }
  check_twice(source);
  source.matrix.entries.conservativeResize(rows, rows);
}

}  // namespace limber::fem
