// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/scene/scenario/scenario.hpp"
#include "limber/scene/text/toml_table.hpp"

namespace limber::scene {

/// Reads `coupler`, `quantity`, `side` and `frame` of a [[probe]].
[[nodiscard]] CouplerProbeSpec read_coupler_probe(TomlTable& table);

}  // namespace limber::scene
