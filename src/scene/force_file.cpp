// SPDX-License-Identifier: BSD-3-Clause
#include "scene/force_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <string>

#include "common/errors.hpp"

namespace limber::scene {
namespace {

using Row = std::vector<double>;

class Reader {
 public:
  Reader(const std::filesystem::path& file, const char* kind)
      : file_(file), stream_(file) {
    if (!stream_) {
      throw InputError(
          fmt::format("{}: cannot read this {}", file.string(), kind));
    }
  }

  /// The next row that is not blank; false at the end.
  bool next(Row& row) {
    for (std::string line; std::getline(stream_, line);) {
      ++line_;
      row = parse(line);
      if (!row.empty()) return true;
    }
    return false;
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}:{}: {}", file_.string(), line_, what));
  }

 private:
  Row parse(const std::string& line) const {
    // strtod would end there in silence.
    if (line.find('\0') != std::string::npos) {
      fail("it holds a byte 0, so it is no text of numbers");
    }
    Row row;
    const char* at = line.c_str();
    for (;;) {
      char* end = nullptr;
      const double value = std::strtod(at, &end);
      if (end == at) break;
      if (!std::isfinite(value)) {
        fail(fmt::format("value {} is {}; expected a finite number",
                         row.size() + 1, value));
      }
      row.push_back(value);
      at = end;
    }
    const std::string rest = at;
    if (const auto junk = rest.find_first_not_of(" \t\r");
        junk != std::string::npos) {
      fail(fmt::format("'{}' is not a number", rest.substr(junk, 20)));
    }
    return row;
  }

  const std::filesystem::path& file_;
  std::ifstream stream_;
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

/// A column that repeats the one before changes nothing.
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
