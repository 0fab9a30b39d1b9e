// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "limber/common/material/section_regions.hpp"
#include "limber/scene/text/xml_element.hpp"

/// <shell> and <beam> of <flexible>.
namespace limber::scene {

/// Problems are added to the element's.
[[nodiscard]] ShellRegion read_shell(XmlElement& element);
[[nodiscard]] BeamRegion read_beam(XmlElement& element);

/// Reads `attributes`, as an element <tag> of a robot has them, by `read`.
/// @param option that has them, for messages
/// @throws InputError with all problems
void read_attributes(const std::string& option, const std::string& tag,
                     const std::string& attributes,
                     const XmlElement::Reader& read);

}  // namespace limber::scene
