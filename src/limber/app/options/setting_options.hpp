// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "limber/scene/build/scene.hpp"

namespace limber::app {

/// `--set KEY=VALUE`, `--unset KEY` and `--package NAME=FOLDER`, each as often
/// as needed, and `--repair-inertia`.
struct SettingOptions {
  std::vector<std::string> set;
  std::vector<std::string> unset;
  std::vector<std::string> packages;  ///< NAME=FOLDER
  bool repairs_inertia = false;
};

void add_settings(CLI::App& command, SettingOptions& options);

/// `--package` and `--repair-inertia` alone.
void add_robot_options(CLI::App& command, SettingOptions& options);

/// Packages and repair as settings of [urdf].
/// @throws InputError naming an option without key or '='.
[[nodiscard]] std::vector<scene::Setting> to_settings(
    const SettingOptions& options);

/// The overrides to load a scene with.
/// @param fidelity of `--fidelity`; none: the file's levels
/// @throws InputError as to_settings, and for an unknown level.
[[nodiscard]] scene::Overrides to_overrides(
    const SettingOptions& options, const std::optional<std::string>& fidelity);

}  // namespace limber::app
