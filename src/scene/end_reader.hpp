// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

#include "scene/robot.hpp"
#include "scene/xml_element.hpp"

/// Readers of the ends of couplers.
namespace limber::scene {

/// The end that an element's place and `rpy` make.
[[nodiscard]] ConnectorEnd read_end(XmlElement& element);

/// Both ends of a coupler, by children <from> and <to> or by attributes of
/// these names, and all its children: `others` by their readers.
void read_ends(XmlElement& element, ConnectorEnd& from, ConnectorEnd& to,
               std::map<std::string, XmlElement::Reader> others = {});

}  // namespace limber::scene
