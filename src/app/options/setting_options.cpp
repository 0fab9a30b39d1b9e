// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/options/setting_options.hpp"

namespace limber::app {

void add_settings(CLI::App& command, SettingOptions& options) {
  command
      .add_option("--set", options.set,
                  "KEY=VALUE: a key of the scenario or the robot by its path, "
                  "as in load.strike.force.2=-200 or "
                  "robot.joint.elbow.limit.upper=1 (as often as needed)")
      ->allow_extra_args(false);
  command
      .add_option("--unset", options.unset,
                  "KEY: removes a key of the scenario or the robot, as in "
                  "time.steps")
      ->allow_extra_args(false);
}

std::vector<scene::Setting> to_settings(const SettingOptions& options) {
  std::vector<scene::Setting> settings;
  for (const std::string& path : options.unset) {
    settings.push_back({path, std::nullopt});
  }
  for (const std::string& text : options.set) {
    settings.push_back(scene::parse_setting(text));
  }
  return settings;
}

scene::Overrides to_overrides(const SettingOptions& options,
                              const std::optional<std::string>& fidelity) {
  scene::Overrides overrides;
  overrides.settings = to_settings(options);
  if (fidelity) overrides.fidelity = dynamics::parse_fidelity(*fidelity);
  return overrides;
}

}  // namespace limber::app
