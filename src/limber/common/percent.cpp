// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/percent.hpp"

#include <fmt/format.h>

namespace limber {

std::string to_percent(std::optional<double> fraction) {
  if (!fraction) return "none";
  const double percent = 100.0 * *fraction;
  return percent < 10.0 ? fmt::format("{:.2g} %", percent)
                        : fmt::format("{:.3g} %", percent);
}

}  // namespace limber
