// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/scene/scenario/scenario.hpp"
#include "limber/scene/text/toml_table.hpp"

namespace limber::scene {

/// Every [[contact]], with what [contact_default] gives for it, and notices of
/// the values that none of them gives.
void read_contacts(TomlTable& root, Scenario& scenario);

}  // namespace limber::scene
