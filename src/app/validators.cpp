// SPDX-License-Identifier: BSD-3-Clause
#include "app/validators.hpp"

#include <fmt/format.h>

#include <cmath>

namespace limber::app {

CLI::Validator make_positive() {
  const auto check = [](std::string& text) -> std::string {
    double value = 0.0;
    const bool is_number = CLI::detail::lexical_cast(text, value);
    if (is_number && std::isfinite(value) && value > 0.0) return {};
    return fmt::format("is {}; expected a number > 0", text);
  };
  return {check, "POSITIVE"};
}

}  // namespace limber::app
