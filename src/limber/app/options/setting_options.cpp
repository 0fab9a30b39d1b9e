// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/options/setting_options.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "limber/common/echo.hpp"
#include "limber/common/errors.hpp"

namespace limber::app {

void add_settings(CLI::App& command, SettingOptions& options) {
  command
      .add_option("--set", options.set,
                  "A key of the scenario or the robot by its path, for example "
                  "load.strike.force.2=-200 or robot.joint.elbow.limit.upper=1 "
                  "(as often as needed)")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command
      .add_option(
          "--unset", options.unset,
          "Removes a key of the scenario or the robot, for example time.steps")
      ->type_name("KEY")
      ->allow_extra_args(false);
  add_robot_options(command, options);
}

void add_robot_options(CLI::App& command, SettingOptions& options) {
  command
      .add_option("--package", options.packages,
                  "NAME=FOLDER: where package://NAME is; as often as needed "
                  "(else: around the robot's file, LIMBER_PACKAGE_PATH, "
                  "ROS_PACKAGE_PATH)")
      ->allow_extra_args(false);
  command.add_flag("--repair-inertia", options.repairs_inertia,
                   "Replace inertias of robots that no rigid body can have by "
                   "the nearest that one can have");
}

namespace {

scene::Setting parse_package(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size()) {
    throw InputError(
        fmt::format("--package '{}' is no NAME=FOLDER, such as "
                    "franka_description=/opt/franka_description",
                    echo(text)));
  }
  const std::filesystem::path folder =
      std::filesystem::absolute(text.substr(equals + 1));
  return {"urdf.packages.\"" + text.substr(0, equals) + "\"", folder.string()};
}

}  // namespace

std::vector<scene::Setting> to_settings(const SettingOptions& options) {
  std::vector<scene::Setting> settings;
  for (const std::string& path : options.unset) {
    settings.push_back({path, std::nullopt});
  }
  for (const std::string& text : options.set) {
    settings.push_back(scene::parse_setting(text));
  }
  for (const std::string& text : options.packages) {
    settings.push_back(parse_package(text));
  }
  if (options.repairs_inertia) {
    settings.push_back({"urdf.repair_inertia", "true"});
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
