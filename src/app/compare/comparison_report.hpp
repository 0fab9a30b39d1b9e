// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "limber/app/compare/comparison.hpp"

namespace limber::app {

[[nodiscard]] Json to_json(const ComparedRun& run);
[[nodiscard]] Json to_json(const Comparison& comparison);

/// A table with a line a run, the reference last.
[[nodiscard]] std::string to_text(const Comparison& comparison);

}  // namespace limber::app
