// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "joints/signal.hpp"
#include "scene/toml_table.hpp"

namespace limber::scene {

/// Reads `signal = { kind = ... }` and, if there is one, `shaper` of a drive's
/// table. @param folder what files in it are relative to
[[nodiscard]] joints::Signal read_signal(TomlTable& drive,
                                         const std::filesystem::path& folder);

}  // namespace limber::scene
