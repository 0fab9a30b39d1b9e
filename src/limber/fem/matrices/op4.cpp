// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/matrices/op4.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <string>

#include "limber/common/echo.hpp"
#include "limber/fem/matrices/matrix_entries.hpp"
#include "limber/fem/text/text_scanner.hpp"

namespace limber::fem {
namespace {

constexpr std::size_t kOp4Columns = 8;  // of an integer of the head

struct Op4Head {
  long columns = 0;
  long rows = 0;
  bool is_big = false;
  long words = 0;  ///< of a number
  std::string name;
  FieldFormat format;
};

/// Integers of a line, blank where they are missing.
struct Op4Line {
  long first = 0;
  long second = 0;
  long third = 0;
};

bool take_integer(std::string_view& rest, long& value) {
  return parse_whole(take_word(rest), value);
}

Op4Head read_op4_head(TextScanner& scanner) {
  const std::string_view line = scanner.line();
  Op4Head head;
  long form = 0;
  long type = 0;
  const auto field = [&](std::size_t i, long& value) {
    return i * kOp4Columns < line.size() &&
           parse_whole(trim_blanks(line.substr(i * kOp4Columns, kOp4Columns)),
                       value);
  };
  const std::string_view rest =
      line.size() > 4 * kOp4Columns ? line.substr(4 * kOp4Columns) : "";
  head.format = parse_format(
      rest.size() > kOp4Columns ? rest.substr(kOp4Columns) : "", "EDFG");
  if (!field(0, head.columns) || !field(1, head.rows) || !field(2, form) ||
      !field(3, type) || head.columns < 1 || head.rows == 0 ||
      head.columns > kMostMatrixRows ||
      std::labs(head.rows) > kMostMatrixRows || type < 1 || type > 4 ||
      head.format.count == 0) {
    scanner.fail(
        "no head of a matrix. Expected columns, rows, form and type in 8 "
        "columns each, name and format, such as 1P,3E23.16.");
  }
  head.name = trim_blanks(rest.substr(0, kOp4Columns));
  if (type > 2)
    scanner.fail(
        fmt::format("{} is complex. Expected a real matrix.", echo(head.name)));
  head.words = type;
  head.is_big = head.rows < 0;
  head.rows = std::labs(head.rows);
  return head;
}

/// Lines of values have a decimal point; so has the format in a head,
/// 1P,3E23.16.
bool is_value_line(std::string_view line) {
  return line.find('.') != std::string_view::npos &&
         line.find_first_of("Pp,") == std::string_view::npos;
}

class Op4Reader {
 public:
  Op4Reader(TextScanner& scanner, const Op4Head& head)
      : scanner_(&scanner), head_(&head) {}

  MatrixEntries read() {
    for (long last = 0;;) {
      Op4Line record = next_record();
      if (record.first == head_->columns + 1) {
        read_values(0, 0, false);
        return std::move(entries_);
      }
      if (record.first <= last || record.first > head_->columns) {
        scanner_->fail(fmt::format("column {}. Expected one from {} to {}.",
                                   record.first, last + 1, head_->columns + 1));
      }
      last = record.first;
      if (record.second > 0) {
        check_length(record.third,
                     read_values(record.second, record.first, true));
      } else {
        read_strings(record.first, record.third);
      }
    }
  }

 private:
  Op4Line next_record() {
    if (!scanner_->next_text())
      scanner_->fail_at_end(
          fmt::format("a column, or the end of matrix {} (column {})",
                      echo(head_->name), head_->columns + 1));
    Op4Line record;
    std::string_view rest = scanner_->line();
    if (!take_integer(rest, record.first) ||
        !take_integer(rest, record.second) ||
        !take_integer(rest, record.third) || record.second < 0 ||
        record.third < 0)
      scanner_->fail(
          "no head of a column. Expected column, first row and "
          "number of words.");
    return record;
  }

  /// Values from `row` on, as many as stand there. @returns their number
  long read_values(long row, long column, bool is_kept) {
    long count = 0;
    while (scanner_->next_text()) {
      const std::string_view line = scanner_->line();
      if (!is_value_line(line)) {
        scanner_->stay();
        break;
      }
      for (std::size_t i = 0; i < head_->format.count; ++i) {
        const std::size_t start = i * head_->format.width;
        if (start >= line.size()) break;
        const std::string_view text =
            trim_blanks(line.substr(start, head_->format.width));
        const double value = entries_.read(*scanner_, text);
        if (is_kept && row + count > head_->rows)
          scanner_->fail(fmt::format("a value in row {}. Expected {} rows.",
                                     row + count, head_->rows));
        if (is_kept && value != 0.0)
          entries_.add(row + count - 1, column - 1, value, scanner_->number());
        ++count;
      }
    }
    return count;
  }

  /// Runs of values, each behind its length (and a word) and first row.
  void read_strings(long column, long length) {
    while (length > 0) {
      if (!scanner_->next_text()) scanner_->fail_at_end("the rest of a column");
      std::string_view rest = scanner_->line();
      constexpr long kShift = 65536;  // length and row in one word
      long count = 0;
      long row = 0;
      bool is_right = take_integer(rest, count);
      if (head_->is_big) {
        is_right = is_right && take_integer(rest, row);
        length -= count + 1;
      } else {
        row = count % kShift;
        count = count / kShift;
        length -= count;
      }
      if (!is_right || !trim_blanks(rest).empty() || count < 2 || row < 1 ||
          row > head_->rows || length < 0) {
        scanner_->fail(fmt::format(
            "no head of a run of values. Expected {}, within the column's "
            "length.",
            head_->is_big ? "its length and first row"
                          : "65536 times its length plus its first row"));
      }
      check_length(count - 1, read_values(row, column, true));
    }
  }

  void check_length(long stated, long read) const {
    if (stated != read && stated != read * head_->words) {
      scanner_->fail(fmt::format(
          "{} values before this line, where the length before them is {}. "
          "Expected that many numbers, or {} words a number.",
          read, stated, head_->words));
    }
  }

  TextScanner* scanner_;
  const Op4Head* head_;
  MatrixEntries entries_;
};

}  // namespace

std::vector<SourceMatrix> read_op4(const std::filesystem::path& file,
                                   bool is_recovery) {
  TextScanner scanner(file);
  std::vector<SourceMatrix> matrices;
  while (scanner.next_text()) {
    const Op4Head head = read_op4_head(scanner);
    MatrixEntries entries = Op4Reader(scanner, head).read();
    SourceMatrix source;
    source.matrix.file = file.string();
    source.format = "OP4";
    source.name = head.name;
    source.role =
        head.rows == head.columns ? guess_role(head.name) : MatrixRole::other;
    if (is_recovery) {
      source.role = MatrixRole::recovery;
      std::move(entries).make_rectangular(
          static_cast<std::size_t>(head.rows),
          static_cast<std::size_t>(head.columns), source);
    } else if (source.role != MatrixRole::other) {
      std::move(entries).make_symmetric(static_cast<std::size_t>(head.rows),
                                        source);
    }
    matrices.push_back(std::move(source));
  }
  if (matrices.empty()) scanner.fail_at_end("a matrix");
  return matrices;
}

}  // namespace limber::fem
