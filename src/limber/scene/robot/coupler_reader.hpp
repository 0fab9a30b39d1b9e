// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/scene/robot/robot.hpp"
#include "limber/scene/text/xml_element.hpp"

/// Readers of the couplers that Limber adds to URDF.
namespace limber::scene {

/// Reads <coupler joint="..."> into `joint`.
void read_coupler(XmlElement& element, Joint& joint);

[[nodiscard]] Loop read_loop(XmlElement& element);
[[nodiscard]] Connector read_spring(XmlElement& element);
[[nodiscard]] Connector read_bushing(XmlElement& element);
[[nodiscard]] Latch read_latch(XmlElement& element);
[[nodiscard]] Tendon read_tendon(XmlElement& element);
[[nodiscard]] Gear read_gear(XmlElement& element);

}  // namespace limber::scene
