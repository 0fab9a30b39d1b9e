// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "limber/app/reports/check_report.hpp"
#include "limber/common/progress.hpp"
#include "limber/scene/build/scene.hpp"

namespace limber::app {

/// Builds a scene and measures its first steps for half a second.
/// @param cache empty for the default one
/// @throws as scene::build_system
[[nodiscard]] SceneCheck check_scene(const scene::Scene& scene,
                                     const std::filesystem::path& cache,
                                     const Progress& progress);

}  // namespace limber::app
