// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "limber/joints/signal.hpp"
#include "limber/scene/text/toml_table.hpp"

namespace limber::scene {

/// Reads `signal = { kind = ... }` and the optional `shaper` of a drive's
/// table. @param folder to which its file names are relative
[[nodiscard]] joints::Signal read_signal(TomlTable& drive,
                                         const std::filesystem::path& folder);

}  // namespace limber::scene
