// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "limber/scene/text/setting.hpp"

namespace limber::app {

/// `--set KEY=VALUE` and `--unset KEY`, each as often as needed.
struct SettingOptions {
  std::vector<std::string> set;
  std::vector<std::string> unset;
};

void add_settings(CLI::App& command, SettingOptions& options);

/// @throws InputError naming an option without key or '='.
[[nodiscard]] std::vector<scene::Setting> to_settings(
    const SettingOptions& options);

}  // namespace limber::app
