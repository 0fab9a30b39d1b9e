// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/matrices/harwell_boeing.hpp"

#include <fmt/format.h>

#include <array>
#include <string>
#include <vector>

#include "limber/common/echo.hpp"
#include "limber/common/index.hpp"
#include "limber/common/upper_case.hpp"
#include "limber/fem/matrices/matrix_entries.hpp"
#include "limber/fem/text/text_scanner.hpp"

namespace limber::fem {
namespace {

struct BoeingHead {
  std::string title;
  bool is_symmetric = false;
  long size = 0;
  long entries = 0;
  FieldFormat pointers;
  FieldFormat indices;
  FieldFormat values;
};

void next_head_line(TextScanner& scanner, const char* what) {
  if (!scanner.next()) scanner.fail_at_end(what);
}

/// The next number of a line of the head, 0 if there is none.
long take_count(const TextScanner& scanner, std::string_view& rest) {
  const std::string_view word = take_word(rest);
  constexpr long kMost = 2'000'000'000;
  long value = 0;
  if (!word.empty() &&
      (!parse_whole(word, value) || value < 0 || value > kMost))
    scanner.fail(fmt::format("'{}' is not a count. Expected an integer from 0.",
                             echo(word)));
  return value;
}

FieldFormat read_field_format(const TextScanner& scanner,
                              std::string_view& rest,
                              std::string_view letters) {
  const std::size_t open = rest.find('(');
  const std::size_t close = rest.find(')', open == rest.npos ? 0 : open);
  FieldFormat format;
  if (open != rest.npos && close != rest.npos) {
    format = parse_format(rest.substr(open, close - open), letters);
    rest.remove_prefix(close + 1);
  }
  if (format.count == 0)
    scanner.fail(
        "a format is missing. Expected those of pointers, rows and values, "
        "such as (I14) (I14) (D25.15).");
  return format;
}

BoeingHead read_boeing_head(TextScanner& scanner) {
  BoeingHead head;
  next_head_line(scanner, "a title");
  head.title = scanner.line();
  next_head_line(scanner, "counts of lines");
  std::string_view rest = scanner.line();
  long right_lines = 0;
  for (int i = 0; i < 5; ++i) right_lines = take_count(scanner, rest);
  next_head_line(scanner, "the matrix's type, RSA or RUA");
  rest = scanner.line();
  const std::string type = to_upper(std::string(take_word(rest)));
  if (type != "RSA" && type != "RUA") {
    scanner.fail(
        fmt::format("matrix type '{}'. Expected RSA or RUA: real, "
                    "symmetric or unsymmetric, assembled.",
                    echo(type)));
  }
  head.is_symmetric = type == "RSA";
  head.size = take_count(scanner, rest);
  const long columns = take_count(scanner, rest);
  head.entries = take_count(scanner, rest);
  if (head.size < 1 || head.size > kMostMatrixRows || columns != head.size) {
    scanner.fail(
        fmt::format("{} rows and {} columns. Expected a square matrix "
                    "of 1 to {} rows.",
                    head.size, columns, kMostMatrixRows));
  }
  next_head_line(scanner, "formats");
  rest = scanner.line();
  head.pointers = read_field_format(scanner, rest, "I");
  head.indices = read_field_format(scanner, rest, "I");
  head.values = read_field_format(scanner, rest, "EDFG");
  if (right_lines > 0) next_head_line(scanner, "the right-hand sides' type");
  return head;
}

long take_index(FieldReader& fields, const TextScanner& scanner, long least,
                long most, const char* what) {
  const std::string_view text = fields.take();
  long value = 0;
  if (!parse_whole(text, value) || value < least || value > most) {
    scanner.fail(
        fmt::format("'{}' is not a {}. Expected an integer from {} to {}.",
                    echo(text), what, least, most));
  }
  return value;
}

}  // namespace

SourceMatrix read_harwell_boeing(const std::filesystem::path& file) {
  TextScanner scanner(file);
  const BoeingHead head = read_boeing_head(scanner);
  std::vector<long> pointers;
  FieldReader pointer_fields(scanner, head.pointers);
  for (long j = 0; j <= head.size; ++j) {
    pointers.push_back(
        take_index(pointer_fields, scanner, j == 0 ? 1 : pointers.back(),
                   j == 0 ? 1 : head.entries + 1, "pointer to a column"));
  }
  pointer_fields.end();
  if (pointers.back() != head.entries + 1) {
    scanner.fail(
        fmt::format("the last pointer is {}. Expected {}, one more "
                    "than the head's number of entries.",
                    pointers.back(), head.entries + 1));
  }
  std::vector<int> rows;
  FieldReader row_fields(scanner, head.indices);
  for (long k = 0; k < head.entries; ++k)
    rows.push_back(
        static_cast<int>(take_index(row_fields, scanner, 1, head.size, "row")));
  row_fields.end();
  MatrixEntries entries;
  entries.reserve(static_cast<std::size_t>(head.entries), file);
  FieldReader value_fields(scanner, head.values);
  for (long j = 0; j < head.size; ++j) {
    for (long k = pointers[index(static_cast<int>(j))];
         k < pointers[index(static_cast<int>(j)) + 1]; ++k) {
      const long row = rows[static_cast<std::size_t>(k) - 1] - 1;
      const double value = entries.read(scanner, value_fields.take());
      if (head.is_symmetric && row < j) {
        scanner.fail(
            fmt::format("entry ({}, {}) is above the diagonal. "
                        "Expected the lower triangle of type RSA.",
                        row + 1, j + 1));
      }
      entries.add(row, j, value, scanner.number());
    }
  }
  value_fields.end();
  SourceMatrix source;
  source.matrix.file = file.string();
  source.format = "Harwell-Boeing";
  source.role = guess_role(head.title);
  std::move(entries).make_symmetric(static_cast<std::size_t>(head.size),
                                    source);
  return source;
}

}  // namespace limber::fem
