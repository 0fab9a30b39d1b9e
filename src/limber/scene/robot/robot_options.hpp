// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace limber::scene {

/// How a robot's file is read.
struct RobotOptions {
  /// Folders of packages by name, for `package://NAME/PATH`.
  std::map<std::string, std::filesystem::path> packages = {};
  /// Replaces inertias that no mass has by the nearest that one has.
  bool repair_inertia = false;

  bool operator==(const RobotOptions&) const = default;
};

}  // namespace limber::scene
