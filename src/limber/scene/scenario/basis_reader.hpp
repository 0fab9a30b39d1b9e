// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/scene/scenario/scenario.hpp"
#include "limber/scene/text/toml_table.hpp"

namespace limber::scene {

/// Reads [basis] and its [basis.links.NAME] into a scenario; problems are added
/// to the table's.
void read_basis(TomlTable& table, Scenario& scenario);

}  // namespace limber::scene
