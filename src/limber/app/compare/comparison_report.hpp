// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "limber/app/console/json.hpp"
#include "limber/runs/compare/comparison.hpp"

namespace limber::app {

/// @param reference null for the reference itself
[[nodiscard]] Json to_json(const runs::ComparedRun& run,
                           const runs::ComparedRun* reference);
[[nodiscard]] Json to_json(const runs::Comparison& comparison);

/// A table with one line per run, the reference last.
[[nodiscard]] std::string to_text(const runs::Comparison& comparison);

}  // namespace limber::app
