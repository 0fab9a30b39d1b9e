// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "limber/fem/matrices/source_matrix.hpp"
#include "limber/fem/text/text_scanner.hpp"

namespace limber::fem {

/// Larger matrices are refused.
inline constexpr long kMostMatrixRows = 10'000'000;

/// Entries of a matrix as a file gives them, in any order.
class MatrixEntries {
 public:
  /// Memory for `count` entries, or fewer if the file is too short for them.
  void reserve(std::size_t count, const std::filesystem::path& file);
  /// @param row, column from 0
  void add(long row, long column, double value, std::size_t line);
  /// Reads a number and remembers in how many digits it is written.
  /// @throws InputError naming the scanner's line unless it is finite
  [[nodiscard]] double read(const TextScanner& scanner, std::string_view text);
  void set_exact() { is_exact_ = true; }  ///< integers: all digits count

  [[nodiscard]] std::size_t size() const { return values_.size(); }
  [[nodiscard]] bool empty() const { return values_.empty(); }

  /// The symmetric matrix: entries without a counterpart are mirrored if no
  /// entry has one; with both triangles the mean is taken, after a check that
  /// they agree. Fills `matrix` and `triangles` of `source`.
  /// @param size rows of the matrix
  /// @throws InputError naming file, lines and entries where one is given
  /// twice, the triangles differ or an entry lacks its counterpart
  void make_symmetric(std::size_t size, SourceMatrix& source) &&;

  /// The matrix as it is given, which need not be square.
  /// @throws InputError naming file and lines where an entry is given twice
  void make_rectangular(std::size_t rows, std::size_t columns,
                        SourceMatrix& source) &&;

 private:
  [[nodiscard]] Eigen::SparseMatrix<double> assemble(
      Eigen::Index rows, Eigen::Index columns,
      const SourceMatrix& source) const;
  [[nodiscard]] int count_all_digits() const;
  [[nodiscard]] std::vector<std::uint32_t> sort() const;
  [[nodiscard]] std::size_t find_line(int row, int column) const;

  std::vector<int> rows_;
  std::vector<int> columns_;
  std::vector<double> values_;
  std::vector<std::uint32_t> lines_;
  int digits_ = 0;           // of positive numbers
  int negative_digits_ = 0;  // of negative ones, whose sign may cost one
  bool is_exact_ = false;
};

}  // namespace limber::fem
