// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/text/force_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>

#include "limber/common/echo.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/files/input_file.hpp"
#include "limber/common/parse_number.hpp"

namespace limber::scene {
namespace {

using Row = std::vector<double>;

constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 32;

class Reader {
 public:
  Reader(const std::filesystem::path& file, const char* kind)
      : file_(file),
        text_(read_input(file, {kind, kMostBytes})),
        left_(text_) {}

  /// The next row that is not blank; false at the end.
  bool next(Row& row) {
    while (!left_.empty()) {
      const std::size_t end = std::min(left_.find('\n'), left_.size());
      ++line_;
      row = parse(left_.substr(0, end));
      left_.remove_prefix(std::min(end + 1, left_.size()));
      if (!row.empty()) return true;
    }
    return false;
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}:{}: {}", file_.string(), line_, what));
  }

 private:
  Row parse(std::string_view line) const {
    Row row;
    for (const std::string_view word : split_words(line)) {
      const std::optional<double> value = parse_number(word);
      if (!value) {
        if (word.find('\0') != std::string_view::npos) {
          fail("it holds a byte 0, so it is not a text of numbers");
        }
        fail(fmt::format("value {}: '{}' is not a number, or not a finite one",
                         row.size() + 1, echo(word)));
      }
      row.push_back(*value);
    }
    return row;
  }

  const std::filesystem::path& file_;
  std::string text_;
  std::string_view left_;
  int line_ = 0;
};

Row read_times(Reader& reader) {
  Row times;
  if (!reader.next(times)) reader.fail("it holds no times");
  for (std::size_t i = 1; i < times.size(); ++i) {
    if (times[i] > times[i - 1]) continue;
    reader.fail(
        fmt::format("time {} is {:g} s, not after {:g} s; times must "
                    "increase",
                    i + 1, times[i], times[i - 1]));
  }
  return times;
}

MatrixX to_matrix(const std::vector<Row>& rows, std::size_t columns) {
  MatrixX matrix(static_cast<Eigen::Index>(rows.size()),
                 static_cast<Eigen::Index>(columns));
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
      matrix(i, j) =
          rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    }
  }
  return matrix;
}

/// Removes columns equal to the previous one.
ForceFile without_repeats(const Row& times, const MatrixX& forces) {
  ForceFile result;
  std::vector<Eigen::Index> kept;
  for (Eigen::Index j = 0; j < forces.cols(); ++j) {
    if (j > 0 && forces.col(j) == forces.col(j - 1)) continue;
    kept.push_back(j);
    result.times.push_back(times[static_cast<std::size_t>(j)]);
  }
  result.forces = forces(Eigen::all, kept);
  return result;
}

}  // namespace

ForceFile read_force_file(const std::filesystem::path& file) {
  Reader reader(file, "force file");
  const Row times = read_times(reader);
  std::vector<Row> rows;
  for (Row row; reader.next(row);) {
    if (row.size() != times.size()) {
      reader.fail(
          fmt::format("{} forces for {} times", row.size(), times.size()));
    }
    rows.push_back(std::move(row));
  }
  return without_repeats(times, to_matrix(rows, times.size()));
}

VectorX read_nodal_field(const std::filesystem::path& file) {
  Reader reader(file, "nodal field");
  std::vector<double> values;
  for (Row row; reader.next(row);) {
    if (row.size() != 1) {
      reader.fail(fmt::format(
          "{} values; expected one, a row for each free degree of freedom",
          row.size()));
    }
    values.push_back(row.front());
  }
  if (values.empty()) reader.fail("it holds no values");
  return Eigen::Map<const VectorX>(values.data(),
                                   static_cast<Eigen::Index>(values.size()));
}

}  // namespace limber::scene
