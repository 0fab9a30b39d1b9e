// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/length_unit.hpp"

#include <array>
#include <utility>

#include "limber/common/parse_number.hpp"

namespace limber {
namespace {

constexpr std::array<std::pair<std::string_view, double>, 5> kMetres = {
    {{"m", 1.0}, {"cm", 1e-2}, {"mm", 1e-3}, {"in", 0.0254}, {"ft", 0.3048}}};

constexpr std::array<std::pair<std::string_view, double>, 3> kNewtons = {
    {{"N", 1.0}, {"kN", 1e3}, {"lbf", 4.4482216152605}}};

template <typename Units>
std::optional<double> find_unit(const Units& units, std::string_view text) {
  for (const auto& [name, value] : units) {
    if (text == name) return value;
  }
  const std::optional<double> value = parse_number(text);
  return value && *value > 0.0 ? value : std::nullopt;
}

}  // namespace

std::optional<double> parse_length_unit(std::string_view text) {
  return find_unit(kMetres, text);
}

bool is_metric(double metres) {
  return metres == 1.0 || metres == 1e-2 || metres == 1e-3;
}

std::optional<double> parse_force_unit(std::string_view text) {
  return find_unit(kNewtons, text);
}

}  // namespace limber
