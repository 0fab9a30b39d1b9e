// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/scene/build/scene.hpp"
#include "limber/scene/text/toml_settings.hpp"

namespace limber::scene {

/// Settings of robots without effect in this scene, each with the reason: a
/// value of URDF that an element of Limber's own replaces, or that the joint's
/// type, the link's level or the rest of the scenario makes irrelevant. A file
/// may have such values for other programs or scenarios, but a user who sets
/// one expects the result to change.
[[nodiscard]] std::vector<std::string> find_unused_settings(
    const std::vector<RobotSetting>& settings, const Scene& scene);

}  // namespace limber::scene
