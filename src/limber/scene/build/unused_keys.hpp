// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <toml++/toml.h>

#include <string>
#include <vector>

#include "limber/scene/build/scene.hpp"

namespace limber::scene {

/// Keys of a scenario file without effect on its scene, each with the reason,
/// and loads, releases and obstacles that never act.
/// @param file as parsed, without errors
/// @param scene with its overrides; with `overrides.fidelity` the file's levels
/// are not checked
[[nodiscard]] std::vector<std::string> find_unused_keys(
    const toml::table& file, const Scene& scene, const Overrides& overrides);

}  // namespace limber::scene
