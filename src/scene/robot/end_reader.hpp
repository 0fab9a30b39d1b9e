// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

#include "scene/robot.hpp"
#include "scene/xml_element.hpp"

/// Readers of the ends of couplers.
namespace limber::scene {

/// Which ends of a coupler have axes that `rpy` may turn.
enum class TurnedEnds { none, from, both };

/// The end that an element's place makes, with the link's axes.
[[nodiscard]] ConnectorEnd read_end(XmlElement& element);

/// Both ends of a coupler, by children <from> and <to> or by attributes of
/// these names, and all its children: `others` by their readers.
void read_ends(XmlElement& element, TurnedEnds turned, ConnectorEnd& from,
               ConnectorEnd& to,
               std::map<std::string, XmlElement::Reader> others = {});

}  // namespace limber::scene
