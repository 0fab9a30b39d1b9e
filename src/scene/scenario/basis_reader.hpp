// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scene/scenario.hpp"
#include "scene/toml_table.hpp"

namespace limber::scene {

/// Reads [basis] and its [basis.links.NAME] into a scenario; problems go to the
/// table's.
void read_basis(TomlTable& table, Scenario& scenario);

}  // namespace limber::scene
