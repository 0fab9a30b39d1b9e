// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "limber/scene/robot/robot_options.hpp"

namespace limber::scene {

/// The file `NAME/PATH` of `package://NAME/PATH`, absolute; nothing if there is
/// none. A package is a folder. It is looked for, in this order, among
/// `options.packages`, in `folder` and those above it, and in the folders that
/// the environment variables LIMBER_PACKAGE_PATH and ROS_PACKAGE_PATH list,
/// separated by ':', themselves, in them and one level deeper.
/// @param folder of the robot's file
[[nodiscard]] std::filesystem::path find_in_package(
    const std::string& name, const std::filesystem::path& folder,
    const RobotOptions& options);

}  // namespace limber::scene
