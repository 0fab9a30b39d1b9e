// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "limber/scene/robot/robot.hpp"

namespace limber::scene {

/// Reads a URDF file and Limber's extension of it.
/// @throws InputError with every problem of the file, each with its line.
[[nodiscard]] Robot read_robot(const std::filesystem::path& file);

}  // namespace limber::scene
