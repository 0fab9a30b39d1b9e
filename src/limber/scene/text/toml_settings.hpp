// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <toml++/toml.h>

#include <string>
#include <vector>

#include "limber/scene/text/setting.hpp"

namespace limber::scene {

/// A setting of a robot's file.
struct RobotSetting {
  Setting setting;
  std::string robot;  ///< name of the [[robot]]; empty: the only one
  std::vector<std::string> parts;  ///< "robot", KIND, NAME, ..., ATTRIBUTE
};

struct SortedSettings {
  std::vector<Setting> scenario;
  std::vector<RobotSetting> robots;
};

/// Sorts settings by file. `robot.KIND.NAME.ATTRIBUTE` is in the robot's file;
/// with several robots `robot.ROBOT.KIND.NAME.ATTRIBUTE` is, and shorter paths
/// are the scenario's (`robot.ROBOT.position.0`).
/// @throws InputError naming every setting whose path is malformed or names an
/// unknown robot.
[[nodiscard]] SortedSettings sort_settings(const std::vector<Setting>& settings,
                                           const toml::table& scenario);

/// Applies settings to a parsed scenario.
///
/// A part of a path is the key of a table, or for an array the 0-based index of
/// an entry or the `name` of a table in it. Keys that are not in the file are
/// added, with the tables around them; the reader of the scenario checks
/// whether it knows them. Nodes that are set have the setting's text as their
/// source().path.
/// @throws InputError naming every setting whose path leads through a value or
/// to a missing entry of an array, is a table, is given twice, or is to be
/// removed but missing.
void apply_settings(const std::vector<Setting>& settings, toml::table& root);

/// The value of a setting as one TOML node under the key `value`.
/// @param source its source().path
[[nodiscard]] toml::table parse_value(const std::string& value,
                                      const std::string& source);

}  // namespace limber::scene
