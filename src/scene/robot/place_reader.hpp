// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "flexbody/node_selection.hpp"
#include "scene/place.hpp"
#include "scene/toml_table.hpp"
#include "scene/xml_element.hpp"

/// Readers of node selections and places.
namespace limber::scene {

/// The one selection that an element's attributes make; a problem if there is
/// none or more than one.
[[nodiscard]] flexbody::NodeSelection read_nodes(XmlElement& element);

/// `weighting` of a selection's nodes: uniform or equal.
[[nodiscard]] flexbody::Weighting read_weighting(XmlElement& element);

/// The place that an element's attributes make; a problem if they select nodes
/// in more than one way.
[[nodiscard]] Place read_place(XmlElement& element);

/// The place that a table's keys make; a problem if they make more than one.
[[nodiscard]] Place read_place(TomlTable& table);

}  // namespace limber::scene
