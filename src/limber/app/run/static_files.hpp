// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "limber/app/console/json.hpp"
#include "limber/runs/analyses/static_run.hpp"

namespace limber::app {

/// For summary.json and --json.
[[nodiscard]] Json summarize(const runs::StaticRun& run);

/// Writes results.h5, probes.csv, summary.json and files by request.
void write_static(const runs::StaticRun& run,
                  const std::filesystem::path& folder, bool xdmf);

}  // namespace limber::app
