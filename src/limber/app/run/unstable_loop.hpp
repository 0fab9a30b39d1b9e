// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "limber/common/progress.hpp"
#include "limber/scene/build/build_system.hpp"
#include "limber/scene/build/scene.hpp"

namespace limber::app {

/// Controllers whose sampled loop is unstable about the start, as a warning
/// (scene::describe_unstable_loop).
/// @param progress shown on a terminal if the search is long
[[nodiscard]] std::optional<std::string> find_unstable_loop(
    const scene::Scene& scene, const scene::BuiltScene& built,
    const Progress& progress = {});

}  // namespace limber::app
