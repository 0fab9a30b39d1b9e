// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/matrices/matrix_market.hpp"

#include <fmt/format.h>

#include "limber/common/echo.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/upper_case.hpp"
#include "limber/fem/matrices/matrix_entries.hpp"
#include "limber/fem/text/text_scanner.hpp"

namespace limber::fem {
namespace {

struct MarketHead {
  bool is_coordinate = false;
  bool is_integer = false;
  bool is_symmetric = false;
  long rows = 0;
  long columns = 0;
  long entries = 0;  ///< of a coordinate file
};

long read_index(const TextScanner& scanner, std::string_view& rest, long most,
                const char* what) {
  const std::string_view word = take_word(rest);
  long value = 0;
  if (!parse_whole(word, value) || value < 1 || value > most) {
    scanner.fail(
        fmt::format("'{}' is not a {}. Expected an integer from 1 to {}.",
                    echo(word), what, most));
  }
  return value;
}

bool next_market_line(TextScanner& scanner) {
  while (scanner.next_text())
    if (!scanner.line().starts_with('%')) return true;
  return false;
}

MarketHead read_head(TextScanner& scanner) {
  if (!scanner.next()) scanner.fail_at_end("'%%MatrixMarket matrix ...'");
  const std::string upper = to_upper(std::string(scanner.line()));
  std::string_view rest = upper;
  const std::string_view banner = take_word(rest);
  const std::string_view object = take_word(rest);
  const std::string_view layout = take_word(rest);
  const std::string_view field = take_word(rest);
  const std::string_view symmetry = take_word(rest);
  MarketHead head;
  head.is_coordinate = layout == "COORDINATE";
  head.is_integer = field == "INTEGER";
  head.is_symmetric = symmetry == "SYMMETRIC";
  if (banner != "%%MATRIXMARKET" || object != "MATRIX" ||
      (!head.is_coordinate && layout != "ARRAY") ||
      (!head.is_integer && field != "REAL" && field != "DOUBLE") ||
      (!head.is_symmetric && symmetry != "GENERAL")) {
    scanner.fail(
        fmt::format("'{}'. Expected '%%MatrixMarket matrix coordinate|"
                    "array real|integer symmetric|general'.",
                    echo(scanner.line())));
  }
  if (!next_market_line(scanner)) scanner.fail_at_end("the matrix's size");
  std::string_view sizes = scanner.line();
  head.rows = read_index(scanner, sizes, kMostMatrixRows, "number of rows");
  head.columns =
      read_index(scanner, sizes, kMostMatrixRows, "number of columns");
  if (head.is_coordinate) {
    constexpr long kMostEntries = 2'000'000'000;
    head.entries =
        read_index(scanner, sizes, kMostEntries, "number of entries");
  }
  if (!trim_blanks(sizes).empty())
    scanner.fail(
        "more numbers than expected. Expected rows, columns and, of a "
        "coordinate file, entries.");
  return head;
}

void read_coordinates(TextScanner& scanner, const MarketHead& head,
                      MatrixEntries& entries) {
  entries.reserve(static_cast<std::size_t>(head.entries), scanner.file());
  for (long k = 0; k < head.entries; ++k) {
    if (!next_market_line(scanner)) {
      scanner.fail_at_end(fmt::format(
          "{} entries, as stated in the size line, not {}", head.entries, k));
    }
    std::string_view rest = scanner.line();
    const long row = read_index(scanner, rest, head.rows, "row");
    const long column = read_index(scanner, rest, head.columns, "column");
    const double value = entries.read(scanner, take_word(rest));
    if (!trim_blanks(rest).empty())
      scanner.fail(
          "more than one entry on this line. Expected row, column, value.");
    if (head.is_symmetric && row < column) {
      scanner.fail(
          fmt::format("entry ({}, {}) is above the diagonal. Expected "
                      "the lower triangle only of a symmetric file.",
                      row, column));
    }
    entries.add(row - 1, column - 1, value, scanner.number());
  }
}

void read_array(TextScanner& scanner, const MarketHead& head,
                MatrixEntries& entries) {
  std::string_view rest;
  std::string_view word;
  for (long j = 0; j < head.columns; ++j) {
    for (long i = head.is_symmetric ? j : 0; i < head.rows; ++i) {
      while ((word = take_word(rest)).empty()) {
        if (!next_market_line(scanner))
          scanner.fail_at_end(
              fmt::format("the values of {} columns, not {}", head.columns, j));
        rest = scanner.line();
      }
      const double value = entries.read(scanner, word);
      if (value != 0.0) entries.add(i, j, value, scanner.number());
    }
  }
  if (!trim_blanks(rest).empty())
    scanner.fail(
        "more values than stated in the size line. Expected the end of the "
        "file.");
}

}  // namespace

SourceMatrix read_matrix_market(const std::filesystem::path& file,
                                bool is_recovery) {
  TextScanner scanner(file);
  const MarketHead head = read_head(scanner);
  if (head.is_symmetric && (head.rows != head.columns || is_recovery)) {
    scanner.fail(fmt::format(
        "'symmetric', {} rows and {} columns. Expected {}.", head.rows,
        head.columns,
        is_recovery ? "'general' for recovery rows" : "a square matrix"));
  }
  MatrixEntries entries;
  if (head.is_integer) entries.set_exact();
  if (head.is_coordinate) {
    read_coordinates(scanner, head, entries);
  } else {
    read_array(scanner, head, entries);
  }
  if (next_market_line(scanner))
    scanner.fail(
        "more lines than stated in the size line. Expected the end of the "
        "file.");
  SourceMatrix source;
  source.matrix.file = file.string();
  source.format = "Matrix Market";
  if (is_recovery || head.rows != head.columns) {
    source.role = MatrixRole::recovery;
    std::move(entries).make_rectangular(static_cast<std::size_t>(head.rows),
                                        static_cast<std::size_t>(head.columns),
                                        source);
    return source;
  }
  std::move(entries).make_symmetric(static_cast<std::size_t>(head.rows),
                                    source);
  return source;
}

std::vector<long> read_node_map(const std::filesystem::path& file) {
  TextScanner scanner(file);
  const MarketHead head = read_head(scanner);
  if (head.is_coordinate || !head.is_integer || head.columns != 1)
    scanner.fail("no vector of integers. Expected 'array integer', n x 1.");
  std::vector<long> nodes;
  for (long i = 0; i < head.rows; ++i) {
    if (!next_market_line(scanner)) {
      scanner.fail_at_end(fmt::format("{} node numbers, not {}", head.rows, i));
    }
    std::string_view rest = scanner.line();
    constexpr long kMostNode = 2'000'000'000;
    nodes.push_back(read_index(scanner, rest, kMostNode, "node number"));
    if (!trim_blanks(rest).empty())
      scanner.fail(
          "more than one number on this line. Expected a node number.");
  }
  if (next_market_line(scanner))
    scanner.fail(
        "more lines than stated in the size line. Expected the end of the "
        "file.");
  return nodes;
}

}  // namespace limber::fem
