// SPDX-License-Identifier: BSD-3-Clause
#include "scene/series_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>

#include "common/errors.hpp"

namespace limber::scene {
namespace {

bool is_passed_over(const std::string& line) {
  const auto first = line.find_first_not_of(" \t\r");
  return first == std::string::npos || line[first] == '#';
}

bool is_heading(const std::string& line) {
  return std::none_of(line.begin(), line.end(),
                      [](unsigned char c) { return std::isdigit(c) != 0; });
}

}  // namespace

Series read_series(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) {
    throw InputError(fmt::format("{}: cannot read this table", file.string()));
  }
  Series series;
  int number = 0;
  bool may_be_heading = true;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    if (is_passed_over(line)) continue;
    const bool skip = may_be_heading && is_heading(line);
    may_be_heading = false;
    if (skip) continue;
    std::string text = line;
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c == ',' || c == ';'; },
        ' ');
    std::istringstream words(text);
    double time = 0.0;
    double value = 0.0;
    std::string rest;
    if (!(words >> time >> value) || words >> rest || !std::isfinite(time) ||
        !std::isfinite(value)) {
      throw InputError(fmt::format(
          "{}:{}: '{}' is not a time [s] and a value, two finite numbers",
          file.string(), number, line.substr(0, 40)));
    }
    series.times.push_back(time);
    series.values.push_back(value);
  }
  return series;
}

}  // namespace limber::scene
