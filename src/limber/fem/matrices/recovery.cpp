// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/matrices/recovery.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "limber/common/errors.hpp"
#include "limber/fem/matrices/row_labels.hpp"

namespace limber::fem {
namespace {

using RecoveryRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

void check_label(const SourceMatrix& recovery, std::size_t row) {
  const RowLabel& label = recovery.labels[row];
  if (label.node >= 1 && label.component >= 1 && label.component <= 6) return;
  throw InputError(
      fmt::format("{}: row {} is {}. Expected a displacement (component 1 to "
                  "3) or rotation "
                  "(4 to 6) of a point.",
                  recovery.matrix.file, row + 1, name_row(label)));
}

/// @throws InputError unless the row is that of the unit matrix.
void check_unit_row(const SourceMatrix& recovery, const RecoveryRows& entries,
                    Eigen::Index row, Eigen::Index own) {
  constexpr double kRounding = 1e-6;
  double departure = 1.0;
  double largest = 0.0;
  for (RecoveryRows::InnerIterator it(entries, row); it; ++it) {
    if (it.col() == own) {
      departure = std::abs(it.value() - 1.0);
    } else {
      largest = std::max(largest, std::abs(it.value()));
    }
  }
  departure = std::max(departure, largest);
  if (departure <= kRounding) return;
  throw InputError(fmt::format(
      "{}: row {} recovers {}, which is row {} of the matrices, and differs "
      "from it by {:.3g}. Expected columns in the order of the matrices' rows.",
      recovery.matrix.file, row + 1,
      name_row(recovery.labels[static_cast<std::size_t>(row)]), own + 1,
      departure));
}

/// Equations with those of `more` below.
Eigen::SparseMatrix<double> stack_rows(
    const Eigen::SparseMatrix<double>& equations,
    const std::vector<Eigen::Triplet<double>>& more, Eigen::Index count,
    Eigen::Index columns) {
  std::vector<Eigen::Triplet<double>> all = more;
  for (int j = 0; j < equations.outerSize(); ++j)
    for (Eigen::SparseMatrix<double>::InnerIterator it(equations, j); it; ++it)
      all.emplace_back(static_cast<int>(it.row()), j, it.value());
  Eigen::SparseMatrix<double> stacked(count, columns);
  stacked.setFromTriplets(all.begin(), all.end());
  return stacked;
}

}  // namespace

void check_recovery(FileSet& set, std::size_t rows) {
  SourceMatrix* const recovery = find_recovery(set);
  if (recovery == nullptr) {
    if (!set.points && !set.recovery_rows) return;
    throw InputError(fmt::format(
        "{}: no matrix of recovery rows. Found: {}. Expected one, with a "
        "column for each row of the stiffness.",
        set.source, list_found(set)));
  }
  const auto& entries = recovery->matrix.entries;
  if (static_cast<std::size_t>(entries.cols()) != rows)
    throw InputError(fmt::format(
        "{}: {} x {} entries. Expected {} columns, one for each row of the "
        "stiffness, and a row for each displacement that is recovered.",
        recovery->matrix.file, entries.rows(), entries.cols(), rows));
  const auto count = static_cast<std::size_t>(entries.rows());
  if (set.recovery_rows) {
    recovery->labels = set.recovery_rows->labels;
  } else if (set.points) {
    label_by_points(*set.points, *recovery);
  }
  if (recovery->labels.size() != count)
    throw InputError(fmt::format(
        "{}: it has {} rows, and the meaning of only {} is known. Expected a "
        "table of its points with 3 or 6 rows each or their components "
        "(node,x,y,z,components), or a table of its rows (row,node,component).",
        recovery->matrix.file, count, recovery->labels.size()));
  for (std::size_t i = 0; i < count; ++i) check_label(*recovery, i);
  check_twice(*recovery);
}

std::map<long, Vector3> list_points(const FileSet& set) {
  constexpr double kSame = 1e-6;
  std::map<long, Vector3> points;
  if (!set.points) return points;
  double size = 0.0;
  for (std::size_t i = 0; i < set.points->tags.size(); ++i) {
    points[set.points->tags[i]] = set.points->x[i];
    size = std::max(size, (set.points->x[i] - set.points->x[0]).norm());
  }
  if (!set.nodes) return points;
  for (const Vector3& x : set.nodes->x)
    size = std::max(size, (x - set.points->x[0]).norm());
  for (std::size_t i = 0; i < set.nodes->tags.size(); ++i) {
    const auto found = points.find(set.nodes->tags[i]);
    if (found == points.end() ||
        (found->second - set.nodes->x[i]).norm() <= kSame * size)
      continue;
    throw InputError(
        fmt::format("{}: point {} is not at the position of node {} in {}. "
                    "Expected one place, or another number.",
                    set.points->file.string(), found->first, found->first,
                    set.nodes->file.string()));
  }
  return points;
}

void add_recovery(FileSet& set, const std::vector<RowLabel>& labels,
                  const std::unordered_map<long, int>& places,
                  MatrixModel& model) {
  const SourceMatrix* const recovery = find_recovery(set);
  if (recovery == nullptr) return;
  std::map<RowLabel, Eigen::Index> own;
  for (std::size_t i = 0; i < labels.size(); ++i)
    own[labels[i]] = static_cast<Eigen::Index>(i);
  std::set<std::pair<int, int>> condensed;
  for (const MatrixRow& row : model.condensed)
    condensed.emplace(row.node, row.component);
  const RecoveryRows entries = recovery->matrix.entries;
  std::vector<Eigen::Triplet<double>> equations;
  for (Eigen::Index i = 0; i < entries.rows(); ++i) {
    const RowLabel& label = recovery->labels[static_cast<std::size_t>(i)];
    if (const auto row = own.find(label); row != own.end()) {
      check_unit_row(*recovery, entries, i, row->second);
      continue;
    }
    const auto place = places.find(label.node);
    if (place == places.end())
      throw InputError(fmt::format(
          "{}: point {} of row {} has no coordinates. Expected it in a table "
          "of points or nodes.",
          recovery->matrix.file, label.node, i + 1));
    const MatrixRow row{place->second, label.component - 1};
    if (!condensed.emplace(row.node, row.component).second)
      throw InputError(
          fmt::format("{}: row {} recovers {}, which also follows from the "
                      "input file's constraints. Expected one of them.",
                      recovery->matrix.file, i + 1, name_row(label)));
    for (RecoveryRows::InnerIterator it(entries, i); it; ++it)
      equations.emplace_back(static_cast<int>(model.condensed.size()),
                             static_cast<int>(it.col()), it.value());
    model.condensed.push_back(row);
  }
  model.equations = stack_rows(
      model.equations, equations,
      static_cast<Eigen::Index>(model.condensed.size()), entries.cols());
  model.has_recovery = true;
}

}  // namespace limber::fem
