// SPDX-License-Identifier: BSD-3-Clause
#include "limber/runs/played_scene.hpp"

#include <fmt/format.h>

#include <cmath>
#include <sstream>
#include <string_view>

#include "limber/common/errors.hpp"
#include "limber/common/parse_number.hpp"
#include "limber/flexbody/file/body_file.hpp"
#include "limber/flexbody/model/kept_modes.hpp"
#include "limber/scene/build/load_scene.hpp"

namespace limber::runs {
namespace {

namespace fs = std::filesystem;

constexpr double kMostModes = 1e6;
constexpr double kMostDamping = 0.5;  // as of <damping>
constexpr double kMostFactor = 1e3;

double require_number(const scene::Setting& setting, double least,
                      double most) {
  const std::optional<double> value = parse_number(*setting.value);
  if (value && *value >= least && *value <= most) return *value;
  throw InputError(fmt::format("{} = {}: expected a number from {:g} to {:g}",
                               setting.path, *setting.value, least, most));
}

void scale_steps(double factor, dynamics::SimulationSettings& settings) {
  settings.step *= factor;
  for (dynamics::StepChange& change : settings.step_changes) {
    change.step *= factor;
  }
}

/// The body's file, or beside it one with its lowest modes alone.
fs::path find_body(const fs::path& file, std::optional<int> modes) {
  if (!modes) return file;
  fs::path kept = file.string() + fmt::format("-{}", *modes);
  if (!fs::exists(kept)) {
    flexbody::write_body(
        flexbody::keep_lowest_modes(flexbody::read_body(file), *modes), kept);
  }
  return kept;
}

}  // namespace

PlaySettings parse_play_settings(const std::string& lines) {
  PlaySettings settings;
  std::istringstream in(lines);
  for (std::string line; std::getline(in, line);) {
    if (line.empty()) continue;
    const scene::Setting setting = scene::parse_setting(line);
    if (setting.path == "level") {
      settings.overrides.fidelity = dynamics::parse_fidelity(*setting.value);
    } else if (setting.path == "modes") {
      settings.modes = static_cast<int>(
          std::lround(require_number(setting, 1.0, kMostModes)));
    } else if (setting.path == "damping") {
      settings.damping = require_number(setting, 0.0, kMostDamping);
    } else if (setting.path == "steps") {
      settings.step_factor =
          require_number(setting, 1.0 / kMostFactor, kMostFactor);
    } else {
      settings.overrides.settings.push_back(setting);
    }
  }
  return settings;
}

scene::Scene load_played_scene(const fs::path& scenario,
                               const PlaySettings& settings,
                               const std::map<std::string, fs::path>& bodies) {
  scene::Scene scene = scene::load_scene(scenario, settings.overrides);
  scale_steps(settings.step_factor, scene.scenario.settings);
  for (scene::Link& link : scene.robot.links) {
    if (!link.flexible) continue;
    if (settings.damping) link.flexible->loss_factor = 2.0 * *settings.damping;
    const auto body = bodies.find(link.name);
    if (body == bodies.end()) continue;
    link.flexible->reduced_file = find_body(body->second, settings.modes);
  }
  return scene;
}

}  // namespace limber::runs
