// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "limber/common/types.hpp"

namespace limber::dynamics {

/// LU factors of a square matrix of 6 x 6 blocks whose pattern is an
/// undirected graph. The elimination order (least fill first) and all fill
/// are found once; factoring and solving then allocate nothing. On a chain or
/// a tree there is no fill, so both cost O(blocks).
///
/// Limits     no pivoting between blocks: for matrices like I + K A
///            with K, A symmetric positive semi-definite, whose diagonal
///            blocks remain regular. Rows of one block may differ in scale.
class BlockLu {
 public:
  BlockLu() = default;
  /// `edges` join different blocks, in any order, repeats allowed.
  /// Rows from `first_preceding` on are eliminated before all others.
  BlockLu(int size, const std::vector<std::pair<int, int>>& edges,
          int first_preceding);
  BlockLu(int size, const std::vector<std::pair<int, int>>& edges)
      : BlockLu(size, edges, size) {}

  void set_zero();
  /// Entry block (row, column); it must be on the diagonal or an edge.
  Matrix6& block(int row, int column);
  /// Multiplies every block of a row from the left.
  void scale_row(int row, const Matrix6& factor);
  /// Factors in place. @returns the row whose pivot block is singular, if any;
  /// the cause may include rows eliminated before.
  [[nodiscard]] std::optional<int> factor();
  /// Solves in place, `x` in blocks of six.
  void solve(std::vector<Vector6>& x) const;

  [[nodiscard]] std::size_t stored_blocks() const { return blocks_.size(); }

 private:
  struct Update {
    int lower;   // (i, pivot)
    int upper;   // (pivot, j)
    int target;  // (i, j)
  };
  struct Pivot {
    int row;
    std::vector<int> rows;   // later rows coupled to it
    std::vector<int> lower;  // blocks (rows[i], row)
    std::vector<int> upper;  // blocks (row, rows[i])
    std::vector<Update> updates;
  };
  // Columns of a row, increasing, with their blocks.
  using Row = std::vector<std::pair<int, int>>;

  std::vector<Matrix6> blocks_;
  std::vector<Matrix6> inverses_;
  std::vector<Row> index_;
  std::vector<Pivot> pivots_;
};

}  // namespace limber::dynamics
