// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "limber/scene/robot/robot.hpp"
#include "limber/scene/robot/robot_options.hpp"
#include "limber/scene/text/toml_settings.hpp"

namespace limber::scene {

/// Reads a URDF file and Limber's extension of it.
/// @param settings are applied to it first
/// @throws InputError with every problem of the file, each with its line.
[[nodiscard]] Robot read_robot(const std::filesystem::path& file,
                               const std::vector<RobotSetting>& settings = {},
                               const RobotOptions& options = {});

}  // namespace limber::scene
