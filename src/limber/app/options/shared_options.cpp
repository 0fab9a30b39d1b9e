// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/options/shared_options.hpp"

#include <fmt/format.h>

#include "limber/common/echo.hpp"
#include "limber/common/length_unit.hpp"

namespace limber::app {

CLI::Option* add_scenario(CLI::App& command, std::string& file) {
  return command.add_option("scenario", file, "Scenario file (TOML)")
      ->required();
}

CLI::Option* add_fidelity(CLI::App& command,
                          std::optional<std::string>& level) {
  return command
      .add_option(
          "--fidelity", level,
          "Level of every flexible link, in place of the file's: rigid, "
          "uncoupled, one-way, coupled, nonlinear, full")
      ->type_name("LEVEL");
}

CLI::Option* add_cache_option(CLI::App& command, std::string& folder) {
  return command
      .add_option("--cache", folder,
                  "Folder of reduced bodies (default: LIMBER_CACHE, else "
                  "XDG_CACHE_HOME/limber, else HOME/.cache/limber)")
      ->type_name("FOLDER");
}

CLI::Option* add_out(CLI::App& command, std::string& folder,
                     const std::string& default_name) {
  return command
      .add_option("--out", folder,
                  "Results folder (default: out/" + default_name + ")")
      ->type_name("FOLDER");
}

std::filesystem::path find_results_folder(const std::string& out,
                                          const std::string& default_name) {
  if (!out.empty()) return out;
  return std::filesystem::path("out") / default_name;
}

namespace {

CLI::Option* add_unit_option(CLI::App& command, const char* name, double& value,
                             std::optional<double> (*parse)(std::string_view),
                             std::string_view expected, const char* text) {
  const auto read = [=, &value](const std::string& given) {
    const std::optional<double> found = parse(given);
    if (!found) {
      throw CLI::ValidationError(
          fmt::format("{} is '{}'; expected {}", name, echo(given), expected));
    }
    value = *found;
  };
  return command.add_option_function<std::string>(name, read, text)
      ->type_name("UNIT");
}

}  // namespace

CLI::Option* add_unit(CLI::App& command, double& metres) {
  return add_unit_option(
      command, "--unit", metres, parse_length_unit, kLengthUnits,
      "Length unit of the mesh: m, cm, mm, in, ft or metres (default: the "
      "file's, where it states one, else m)");
}

CLI::Option* add_force_unit(CLI::App& command, double& newtons) {
  return add_unit_option(
      command, "--force-unit", newtons, parse_force_unit, kForceUnits,
      "Unit of force of a deck's materials: N, kN, lbf or newtons (default: N "
      "where lengths are in m, cm or mm)");
}

CLI::Option* add_json(CLI::App& command, bool& is_requested) {
  return command.add_flag("--json", is_requested, "Print one JSON object");
}

}  // namespace limber::app
