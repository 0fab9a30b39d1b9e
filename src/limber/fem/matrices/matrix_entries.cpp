// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/matrices/matrix_entries.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "limber/common/echo.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"

namespace limber::fem {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

constexpr int kMostDigits = 17;  // more do not change a double

/// Order of `keys` by their counts, stable, applied to `order`.
std::vector<std::uint32_t> sort_by(const std::vector<int>& keys, std::size_t n,
                                   const std::vector<std::uint32_t>& order) {
  std::vector<std::uint32_t> start(n + 1, 0);
  for (const int key : keys) ++start[index(key) + 1];
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<std::uint32_t> sorted(keys.size());
  for (const std::uint32_t k : order) sorted[start[index(keys[k])]++] = k;
  return sorted;
}

/// Pairs of entries across the diagonal.
struct Pairs {
  bool has_lower = false;
  bool has_upper = false;
  bool has_both = false;
  bool has_single = false;
  int row = -1;  // of a single entry
  int column = -1;
};

/// @param transposed the matrix, transposed
Pairs find_pairs(const Sparse& matrix, const Sparse& transposed) {
  Pairs pairs;
  for (int j = 0; j < matrix.outerSize(); ++j) {
    Sparse::InnerIterator other(transposed, j);
    for (Sparse::InnerIterator it(matrix, j); it; ++it) {
      if (it.row() == j || it.value() == 0.0) continue;
      while (other && other.row() < it.row()) ++other;
      (it.row() > j ? pairs.has_lower : pairs.has_upper) = true;
      if (other && other.row() == it.row() && other.value() != 0.0) {
        pairs.has_both = true;
      } else if (!pairs.has_single) {
        pairs.has_single = true;
        pairs.row = static_cast<int>(it.row());
        pairs.column = j;
      }
    }
  }
  return pairs;
}

std::string place_entry(const SourceMatrix& source, int row, int column) {
  if (source.labels.empty())
    return fmt::format("({}, {})", row + 1, column + 1);
  return fmt::format("({}, {})", name_row(source.labels[index(row)]),
                     name_row(source.labels[index(column)]));
}

}  // namespace

void MatrixEntries::reserve(std::size_t count,
                            const std::filesystem::path& file) {
  constexpr std::uintmax_t kLeastBytes = 2;  // of an entry
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(file, error);
  if (!error) count = std::min<std::size_t>(count, bytes / kLeastBytes);
  rows_.reserve(count);
  columns_.reserve(count);
  values_.reserve(count);
  lines_.reserve(count);
}

void MatrixEntries::add(long row, long column, double value, std::size_t line) {
  rows_.push_back(static_cast<int>(row));
  columns_.push_back(static_cast<int>(column));
  values_.push_back(value);
  lines_.push_back(static_cast<std::uint32_t>(line));
}

double MatrixEntries::read(const TextScanner& scanner, std::string_view text) {
  double value = 0.0;
  if (!parse_real(text, value)) {
    scanner.fail(fmt::format(
        "'{}' is not a finite number. Expected a value of the matrix.",
        echo(text)));
  }
  int& digits = value < 0.0 ? negative_digits_ : digits_;
  if (digits < kMostDigits) digits = std::max(digits, count_digits(text));
  return value;
}

int MatrixEntries::count_all_digits() const {
  const int most = std::max(digits_, negative_digits_);
  if (is_exact_ || most == 0) return kMostDigits;
  if (negative_digits_ > 0 && negative_digits_ == digits_ - 1)
    return negative_digits_;
  return std::min(most, kMostDigits);
}

std::vector<std::uint32_t> MatrixEntries::sort() const {
  const auto last = std::max(
      rows_.empty() ? 0 : *std::max_element(rows_.begin(), rows_.end()),
      columns_.empty() ? 0
                       : *std::max_element(columns_.begin(), columns_.end()));
  std::vector<std::uint32_t> order(values_.size());
  std::iota(order.begin(), order.end(), 0U);
  order = sort_by(rows_, index(last) + 1, order);
  return sort_by(columns_, index(last) + 1, order);
}

std::size_t MatrixEntries::find_line(int row, int column) const {
  for (std::size_t k = 0; k < values_.size(); ++k)
    if (rows_[k] == row && columns_[k] == column) return lines_[k];
  return 0;
}

Sparse MatrixEntries::assemble(Eigen::Index rows, Eigen::Index columns,
                               const SourceMatrix& source) const {
  Sparse given(rows, columns);
  const std::vector<std::uint32_t> order = sort();
  given.reserve(static_cast<Eigen::Index>(order.size()));
  std::size_t k = 0;
  for (int j = 0; j < columns; ++j) {
    given.startVec(j);
    for (; k < order.size() && columns_[order[k]] == j; ++k) {
      const std::uint32_t e = order[k];
      if (k > 0 && columns_[order[k - 1]] == j &&
          rows_[order[k - 1]] == rows_[e]) {
        throw InputError(fmt::format(
            "{}:{}: entry {} is given twice, first on line {}. Expected "
            "each entry once.",
            source.matrix.file, lines_[e], place_entry(source, rows_[e], j),
            lines_[order[k - 1]]));
      }
      given.insertBackByOuterInner(j, rows_[e]) = values_[e];
    }
  }
  given.finalize();
  return given;
}

void MatrixEntries::make_rectangular(std::size_t rows, std::size_t columns,
                                     SourceMatrix& source) && {
  source.matrix.entries = assemble(static_cast<Eigen::Index>(rows),
                                   static_cast<Eigen::Index>(columns), source);
  source.matrix.digits = count_all_digits();
}

void MatrixEntries::make_symmetric(std::size_t size, SourceMatrix& source) && {
  const auto n = static_cast<Eigen::Index>(size);
  const Sparse given = assemble(n, n, source);
  source.matrix.digits = count_all_digits();

  const Sparse transposed = given.transpose();
  const Pairs pairs = find_pairs(given, transposed);
  if (pairs.has_both && pairs.has_single) {
    throw InputError(fmt::format(
        "{}:{}: entry {} is given and its counterpart {} is not, while others "
        "are given twice. Expected a symmetric matrix: one triangle, or both.",
        source.matrix.file, find_line(pairs.row, pairs.column),
        place_entry(source, pairs.row, pairs.column),
        place_entry(source, pairs.column, pairs.row)));
  }
  Sparse& full = source.matrix.entries;
  if (!pairs.has_both) {
    *this = {};  // its memory
    source.triangles = !pairs.has_single  ? "diagonal"
                       : !pairs.has_upper ? "lower triangle, mirrored"
                       : !pairs.has_lower ? "upper triangle, mirrored"
                                          : "each pair once, mirrored";
    if (!pairs.has_upper) {
      full = given.selfadjointView<Eigen::Lower>();
    } else if (!pairs.has_lower) {
      full = given.selfadjointView<Eigen::Upper>();
    } else {
      full = given + transposed;
      for (int j = 0; j < n; ++j)
        if (full.coeff(j, j) != 0.0) full.coeffRef(j, j) = given.coeff(j, j);
    }
    full.makeCompressed();
    return;
  }
  // The triangles may have been rounded apart; not more than their digits.
  constexpr double kRounding = 1e-9;
  const double tolerance =
      std::max(kRounding, std::pow(10.0, 2 - source.matrix.digits));
  const VectorX diagonal = given.diagonal().cwiseAbs().cwiseSqrt();
  full = given;
  for (int j = 0; j < n; ++j) {
    Sparse::InnerIterator other(transposed, j);
    for (Sparse::InnerIterator it(full, j); it; ++it) {
      while (other && other.row() < it.row()) ++other;
      const double mirror =
          other && other.row() == it.row() ? other.value() : 0.0;
      const double scale = std::max({std::abs(it.value()), std::abs(mirror),
                                     diagonal[j] * diagonal[it.row()]});
      if (std::abs(it.value() - mirror) > tolerance * scale) {
        const auto row = static_cast<int>(it.row());
        throw InputError(fmt::format(
            "{}:{}: entry {} is {:.9g} and {} is {:.9g} (line {}). Expected a "
            "symmetric matrix.",
            source.matrix.file, find_line(row, j), place_entry(source, row, j),
            it.value(), place_entry(source, j, row), mirror,
            find_line(j, row)));
      }
      it.valueRef() = 0.5 * it.value() + 0.5 * mirror;
    }
  }
  full.makeCompressed();
  source.triangles = "both triangles";
}

}  // namespace limber::fem
