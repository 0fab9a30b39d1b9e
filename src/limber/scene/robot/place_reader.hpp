// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/flexbody/model/node_selection.hpp"
#include "limber/scene/robot/place.hpp"
#include "limber/scene/text/toml_table.hpp"
#include "limber/scene/text/xml_element.hpp"

/// Readers of node selections and places.
namespace limber::scene {

/// The selection in an element's attributes; a problem unless there is exactly
/// one.
[[nodiscard]] flexbody::NodeSelection read_nodes(XmlElement& element);

/// `weighting` of a selection's nodes: uniform or equal.
[[nodiscard]] flexbody::Weighting read_weighting(XmlElement& element);

/// The place in an element's attributes; a problem if they select nodes in more
/// than one way.
[[nodiscard]] Place read_place(XmlElement& element);

/// The place in a table's keys; a problem if there is more than one.
[[nodiscard]] Place read_place(TomlTable& table);

}  // namespace limber::scene
