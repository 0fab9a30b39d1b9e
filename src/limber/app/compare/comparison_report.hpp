// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "limber/app/compare/comparison.hpp"

namespace limber::app {

/// @param reference null for the reference itself
[[nodiscard]] Json to_json(const ComparedRun& run,
                           const ComparedRun* reference);
[[nodiscard]] Json to_json(const Comparison& comparison);

/// A table with one line per run, the reference last.
[[nodiscard]] std::string to_text(const Comparison& comparison);

}  // namespace limber::app
