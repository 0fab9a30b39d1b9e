// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <toml++/toml.h>

#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace limber::scene {

/// What a scenario file says in vain: keys that change nothing in its scene, a
/// text for each that says why, and loads and releases that never act.
/// @param file as it was read, without errors
/// @param scene with its overrides, of which a level in place of the file's
/// is `overrides.fidelity`: what the file says of levels is then not judged
[[nodiscard]] std::vector<std::string> find_vain_keys(
    const toml::table& file, const Scene& scene, const Overrides& overrides);

}  // namespace limber::scene
