// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "limber/common/progress.hpp"
#include "limber/scene/build/scene.hpp"
#include "limber/view/play_page.hpp"

namespace limber::app {

/// A scene with all that a page needs to simulate it: its files, its bodies
/// (reduced now, or cached), and what may be changed.
/// @param cache folder of reduced bodies; empty: the default one
/// @throws InputError for what cannot be reduced, for links in pieces or at
/// level `full`, which a page cannot have, and as view::find_playground.
[[nodiscard]] view::Playground make_playground(
    const scene::Scene& scene, const std::filesystem::path& cache,
    const Progress& progress);

}  // namespace limber::app
