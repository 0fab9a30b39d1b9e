// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>

#include "scene/robot.hpp"
#include "scene/xml_element.hpp"

/// Readers of the elements that Limber adds to URDF.
namespace limber::scene {

/// Content of <flexible link="...">; paths are relative to `folder`.
[[nodiscard]] FlexibleLink read_flexible(XmlElement& element,
                                         const std::filesystem::path& folder);

/// Content of <coupler joint="...">.
[[nodiscard]] CouplerOptions read_coupler(XmlElement& element);

/// Content of <spring ...> and <bushing ...>.
[[nodiscard]] Connector read_spring(XmlElement& element);
[[nodiscard]] Connector read_bushing(XmlElement& element);

}  // namespace limber::scene
