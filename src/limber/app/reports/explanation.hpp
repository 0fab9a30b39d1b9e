// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "limber/app/console/json.hpp"
#include "limber/app/reports/run_summary.hpp"

namespace limber::app {

/// What limited the steps of a run, its events, where its time and energy went,
/// and what to try (next_steps.hpp): "status", "limits", "events",
/// "seconds_by_part", "carried", "try" and more.
[[nodiscard]] Json explain(const RunSummary& run);
/// The same on one page.
[[nodiscard]] std::string to_text(const RunSummary& run);

}  // namespace limber::app
