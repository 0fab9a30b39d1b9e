// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/options/validators.hpp"

#include <fmt/format.h>

#include <cmath>

namespace limber::app {

namespace {

CLI::Validator make_range(bool with_zero, const std::string& expected,
                          const std::string& name) {
  const auto check = [=](std::string& text) -> std::string {
    double value = 0.0;
    const bool is_number = CLI::detail::lexical_cast(text, value);
    const bool is_within = value > 0.0 || (with_zero && value == 0.0);
    if (is_number && std::isfinite(value) && is_within) return {};
    return fmt::format("is {}; expected a number {}", text, expected);
  };
  return {check, name};
}

}  // namespace

CLI::Validator make_positive() { return make_range(false, "> 0", "POSITIVE"); }

CLI::Validator make_not_negative() {
  return make_range(true, ">= 0", "NOT NEGATIVE");
}

}  // namespace limber::app
