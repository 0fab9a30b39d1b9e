// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "limber/scene/robot/robot.hpp"
#include "limber/scene/text/xml_element.hpp"

namespace limber::scene {

/// Content of <flexible link="...">; paths are relative to `folder`.
[[nodiscard]] FlexibleLink read_flexible(XmlElement& element,
                                         const std::filesystem::path& folder);

/// Content of its <material>.
[[nodiscard]] std::vector<flexbody::MaterialRegion> read_material(
    XmlElement& element, const std::filesystem::path& folder);

}  // namespace limber::scene
