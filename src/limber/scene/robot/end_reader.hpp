// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

#include "limber/scene/robot/robot.hpp"
#include "limber/scene/text/xml_element.hpp"

/// Readers of the ends of couplers.
namespace limber::scene {

/// Ends of a coupler whose axes `rpy` may rotate.
enum class TurnedEnds { none, from, both };

/// The end at an element's place, with the link's axes.
[[nodiscard]] ConnectorEnd read_end(XmlElement& element);

/// Reads both ends of a coupler, from children <from> and <to> or attributes of
/// these names, and all its other children by the readers `others`.
void read_ends(XmlElement& element, TurnedEnds turned, ConnectorEnd& from,
               ConnectorEnd& to,
               std::map<std::string, XmlElement::Reader> others = {});

}  // namespace limber::scene
