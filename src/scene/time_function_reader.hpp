// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "dynamics/time_function.hpp"
#include "scene/toml_table.hpp"

namespace limber::scene {

/// Reads a load's `time` table: kind = "constant", "steps", "pulse",
/// "sinusoid" or "table", with the keys of that kind.
[[nodiscard]] dynamics::TimeFunction read_time_function(TomlTable& table);

}  // namespace limber::scene
