// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

/// Names in a scenario and its robot, for completing command lines. A file that
/// cannot be read has none.
namespace limber::app {

/// Paths of its keys and of its robot's elements, as --set takes them:
/// "load.strike.force", "robot.joint.elbow.".
[[nodiscard]] std::vector<std::string> list_keys(
    const std::filesystem::path& scenario);

/// Of its probes.
[[nodiscard]] std::vector<std::string> list_probes(
    const std::filesystem::path& scenario);

/// Of its loads, drives and controllers.
[[nodiscard]] std::vector<std::string> list_inputs(
    const std::filesystem::path& scenario);

}  // namespace limber::app
