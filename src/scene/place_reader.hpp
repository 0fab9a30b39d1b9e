// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "flexbody/node_selection.hpp"
#include "scene/scenario.hpp"
#include "scene/toml_table.hpp"
#include "scene/xml_element.hpp"

/// Readers of node selections and places.
namespace limber::scene {

/// The one selection that an element's attributes make; a problem if there is
/// none or more than one.
[[nodiscard]] flexbody::NodeSelection read_nodes(XmlElement& element);

/// The place that a table's keys make; a problem if they make more than one.
[[nodiscard]] Place read_place(TomlTable& table);

}  // namespace limber::scene
