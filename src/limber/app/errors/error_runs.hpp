// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "limber/app/run/run_scene.hpp"
#include "limber/common/progress.hpp"
#include "limber/dynamics/monitors/energy_record.hpp"
#include "limber/runs/error_table.hpp"

namespace limber::app {

/// Errors of a completed run, each cause from one more run, in threads for as
/// many as there are processors.
/// @throws Interrupted if `progress` ends the work
[[nodiscard]] runs::ErrorTable estimate_errors(
    const runs::Run& run, const std::filesystem::path& cache,
    const Progress& progress);

/// Why a run with finer settings is not more accurate than the given one: its
/// energy error is much larger.
[[nodiscard]] std::optional<std::string> find_imbalance(
    const dynamics::EnergyDrift& finer, const dynamics::EnergyDrift& own);

/// Has files and pictures of the run show them.
void add_errors(runs::Run& run, runs::ErrorTable errors);

}  // namespace limber::app
