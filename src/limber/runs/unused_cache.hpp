// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "limber/scene/build/build_system.hpp"

namespace limber::runs {

/// Adds a warning to the scene's if a cache was given and no body needs
/// one.
/// @param cache as given on the command line; empty: not given
/// @param built from files, without bodies known before
void warn_of_unused_cache(const std::filesystem::path& cache,
                          scene::BuiltScene& built);

}  // namespace limber::runs
