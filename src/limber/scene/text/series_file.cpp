// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/text/series_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>

#include "limber/common/echo.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/files/input_file.hpp"
#include "limber/common/parse_number.hpp"

namespace limber::scene {
namespace {

constexpr InputKind kTable = {"table", std::uint64_t{1} << 30};

bool is_heading(std::string_view line) {
  return std::none_of(line.begin(), line.end(),
                      [](unsigned char c) { return std::isdigit(c) != 0; });
}

struct Point {
  double time;
  double value;
};

std::optional<Point> read_point(std::string line) {
  std::replace_if(
      line.begin(), line.end(), [](char c) { return c == ',' || c == ';'; },
      ' ');
  const auto words = split_words(line);
  if (words.size() != 2) return std::nullopt;
  const auto time = parse_number(words[0]);
  const auto value = parse_number(words[1]);
  if (!time || !value) return std::nullopt;
  return Point{*time, *value};
}

}  // namespace

Series read_series(const std::filesystem::path& file) {
  std::istringstream text(read_input(file, kTable));
  Series series;
  int number = 0;
  bool may_be_heading = true;
  for (std::string line; std::getline(text, line);) {
    ++number;
    const auto words = split_words(line);
    if (words.empty() || words.front().starts_with('#')) continue;
    const bool skip = may_be_heading && is_heading(line);
    may_be_heading = false;
    if (skip) continue;
    const std::optional<Point> point = read_point(line);
    if (!point) {
      throw InputError(fmt::format(
          "{}:{}: '{}' is not a time [s] and a value, two finite numbers",
          file.string(), number, echo(line)));
    }
    series.times.push_back(point->time);
    series.values.push_back(point->value);
  }
  return series;
}

}  // namespace limber::scene
