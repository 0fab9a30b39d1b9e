// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/length_unit.hpp"

#include <array>
#include <utility>

#include "limber/common/parse_number.hpp"

namespace limber {
namespace {

constexpr std::array<std::pair<std::string_view, double>, 5> kMetres = {
    {{"m", 1.0}, {"cm", 1e-2}, {"mm", 1e-3}, {"in", 0.0254}, {"ft", 0.3048}}};

}  // namespace

std::optional<double> parse_length_unit(std::string_view text) {
  for (const auto& [name, metres] : kMetres) {
    if (text == name) return metres;
  }
  const std::optional<double> metres = parse_number(text);
  return metres && *metres > 0.0 ? metres : std::nullopt;
}

}  // namespace limber
