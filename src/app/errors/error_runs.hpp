// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "limber/app/reports/error_table.hpp"
#include "limber/app/run/run_scene.hpp"
#include "limber/common/progress.hpp"

namespace limber::app {

/// Errors of a completed run, each cause from one more run, in threads for as
/// many as there are processors.
/// @throws Interrupted if `progress` ends the work
[[nodiscard]] ErrorTable estimate_errors(const Run& run,
                                         const std::filesystem::path& cache,
                                         const Progress& progress);

/// Has files and pictures of the run show them.
void add_errors(Run& run, ErrorTable errors);

}  // namespace limber::app
