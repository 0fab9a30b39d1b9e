// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/run/play_controls.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <variant>

#include "limber/dynamics/system/fidelity.hpp"
#include "limber/flexbody/model/kept_modes.hpp"
#include "limber/scene/scenario/time_settings_reader.hpp"
#include "limber/scene/text/setting.hpp"

namespace limber::app {
namespace {

constexpr double kSomeTumble = 1.0;  // of a body that does not rotate [rad/s]
constexpr std::array<std::string_view, 3> kAxes = {"x", "y", "z"};

using Controls = std::vector<view::PlayControl>;

/// At least `value`: 1, 2 or 5 times a power of ten.
double round_up(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double digit : {1.0, 2.0, 5.0}) {
    if (digit * power >= value) return digit * power;
  }
  return 10.0 * power;
}

/// A slider for each component, on both sides of zero.
void add_vector(const std::string& label, const std::string& path,
                const std::string& unit, const Vector3& value, double most,
                Controls& controls) {
  for (int c = 0; c < 3; ++c) {
    controls.push_back(
        {.label = fmt::format("{} {}", label, kAxes[std::size_t(c)]),
         .path = fmt::format("{}.{}", path, c),
         .vector = path,
         .unit = unit,
         .value = value[c],
         .least = -most,
         .most = most});
  }
}

void add_number(const std::string& label, const std::string& path,
                const std::string& unit, double value, double least,
                double most, Controls& controls) {
  controls.push_back({.label = label,
                      .path = path,
                      .unit = unit,
                      .value = value,
                      .least = least,
                      .most = most});
}

void add_load(const scene::LoadSpec& load, Controls& controls) {
  const std::string path = "load." + scene::quote_part(load.name);
  if (load.force.norm() > 0.0) {
    add_vector(load.name + ": force", path + ".force", "N", load.force,
               round_up(3.0 * load.force.norm()), controls);
  }
  if (load.moment.norm() > 0.0) {
    add_vector(load.name + ": moment", path + ".moment", "N m", load.moment,
               round_up(3.0 * load.moment.norm()), controls);
  }
  if (load.where.point && load.where.point->norm() > 0.0) {
    add_vector(load.name + ": place", path + ".point", "m", *load.where.point,
               load.where.point->norm(), controls);
  }
  if (const auto* pulse = std::get_if<dynamics::Pulse>(&load.time)) {
    add_number(load.name + ": duration", path + ".time.duration", "s",
               pulse->duration, 0.1 * pulse->duration, 5.0 * pulse->duration,
               controls);
  }
}

/// `full` needs the mesh, which a page does not have; `nonlinear` needs tables
/// that bodies of other levels lack.
void add_level(const scene::Scenario& scenario, Controls& controls) {
  const std::string given{to_string(scenario.fidelity)};
  std::vector<std::string> choices = {"rigid", "uncoupled", "one-way",
                                      "coupled"};
  if (std::ranges::find(choices, given) == choices.end()) {
    choices.push_back(given);
  }
  controls.push_back(
      {.label = "level", .path = "level", .choices = choices, .choice = given});
}

bool has_level(const scene::Scene& scene, dynamics::Fidelity level) {
  return std::ranges::any_of(scene.robot.links, [&](const scene::Link& link) {
    return link.flexible && scene.scenario.level_of(link.name) == level;
  });
}

/// Of the body with most; others keep all that they have.
void add_modes(const scene::Scene& scene,
               const std::vector<scene::ReducedPieces>& bodies,
               Controls& controls) {
  int most = 0;
  for (const scene::ReducedPieces& pieces : bodies) {
    for (const auto& body : pieces) {
      if (!flexbody::has_separable_modes(*body)) return;
      most = std::max(most, body->mode_count());
    }
  }
  if (most < 2 || has_level(scene, dynamics::Fidelity::nonlinear)) return;
  controls.push_back({.label = "modes of a link, at most",
                      .path = "modes",
                      .value = double(most),
                      .least = 1.0,
                      .most = double(most),
                      .is_whole = true});
}

/// One value for all links, at first the largest.
void add_damping(const scene::Scene& scene, Controls& controls) {
  double ratio = 0.0;
  for (const scene::Link& link : scene.robot.links) {
    if (!link.flexible) continue;
    ratio = std::max(ratio, 0.5 * link.flexible->loss_factor);
  }
  add_number("damping ratio of links", "damping", "", ratio, 0.0,
             std::clamp(5.0 * ratio, 0.05, 0.5), controls);
}

void add_step(const dynamics::SimulationSettings& settings,
              Controls& controls) {
  if (settings.tolerance == scene::kToleranceToChoose) return;
  const double step = settings.step;
  const double tolerance = settings.tolerance;
  if (tolerance > 0.0) {
    add_number("tolerance", "time.tolerance", "m", tolerance, 0.1 * tolerance,
               10.0 * tolerance, controls);
  } else if (settings.step_changes.empty()) {
    add_number("step", "time.step", "s", step, 0.2 * step, 5.0 * step,
               controls);
  } else {
    add_number("steps, times", "steps", "", 1.0, 0.2, 5.0, controls);
  }
}

void add_contact(const scene::ContactSpec& contact, std::size_t number,
                 Controls& controls) {
  const std::string label =
      fmt::format("{} on {}", contact.between[0], contact.between[1]);
  const std::string path = fmt::format("contact.{}", number);
  if (contact.options.restitution) {
    add_number(label + ": restitution", path + ".restitution", "",
               *contact.options.restitution, 0.0, 1.0, controls);
  }
  if (contact.options.friction) {
    add_number(label + ": friction", path + ".friction", "",
               *contact.options.friction, 0.0,
               std::max(1.5, *contact.options.friction), controls);
  }
}

void add_start(const std::string& name, const std::string& path,
               const scene::BodyStart& start, Controls& controls) {
  if (start.velocity.norm() > 0.0) {
    add_vector(name + ": velocity", path + ".velocity", "m/s", start.velocity,
               round_up(3.0 * start.velocity.norm()), controls);
  }
  if (start.velocity.norm() + start.angular_velocity.norm() > 0.0) {
    const double spin = start.angular_velocity.norm();
    add_vector(name + ": tumble", path + ".angular_velocity", "rad/s",
               start.angular_velocity,
               spin > 0.0 ? round_up(3.0 * spin) : kSomeTumble, controls);
  }
}

}  // namespace

std::vector<view::PlayControl> list_controls(
    const scene::Scene& scene,
    const std::vector<scene::ReducedPieces>& bodies) {
  const scene::Scenario& scenario = scene.scenario;
  Controls controls;
  for (const scene::LoadSpec& load : scenario.loads) add_load(load, controls);
  add_start("base", "initial.base", scenario.base, controls);
  for (const scene::RobotSpec& robot : scenario.robots) {
    add_start(robot.name, "robot." + scene::quote_part(robot.name), robot.start,
              controls);
  }
  for (const scene::ProjectileSpec& body : scenario.projectiles) {
    add_start(body.name, "projectile." + scene::quote_part(body.name),
              body.start, controls);
  }
  for (std::size_t i = 0; i < scenario.contacts.size(); ++i) {
    add_contact(scenario.contacts[i], i, controls);
  }
  const bool bends = std::ranges::any_of(
      scene.robot.links, [](const auto& link) { return bool(link.flexible); });
  if (bends) {
    add_level(scenario, controls);
    add_modes(scene, bodies, controls);
    add_damping(scene, controls);
  }
  add_step(scenario.settings, controls);
  return controls;
}

}  // namespace limber::app
