// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/scene/scenario/scenario.hpp"
#include "limber/scene/text/toml_table.hpp"

namespace limber::scene {

/// Reads `contact` and `quantity` of a [[probe]].
[[nodiscard]] ContactProbeSpec read_contact_probe(TomlTable& table);

}  // namespace limber::scene
