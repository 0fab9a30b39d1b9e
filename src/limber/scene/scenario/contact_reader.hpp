// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/scene/scenario/scenario.hpp"
#include "limber/scene/text/toml_table.hpp"

namespace limber::scene {

/// Reads every [[contact]], with values of [contact_default], and adds notices
/// of the values that neither gives.
void read_contacts(TomlTable& root, Scenario& scenario);

}  // namespace limber::scene
