// SPDX-License-Identifier: BSD-3-Clause
#include "limber/runs/numbered_stages.hpp"

#include <fmt/format.h>

namespace limber::runs {

Progress number_stage(const Progress& progress, int stage, int count) {
  return [progress, stage, count](std::string_view what, double fraction) {
    report(progress, fmt::format("{} of {}, {}", stage, count, what), fraction);
  };
}

}  // namespace limber::runs
