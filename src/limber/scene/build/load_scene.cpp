// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/build/load_scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "limber/common/errors.hpp"
#include "limber/scene/build/basis_choice.hpp"
#include "limber/scene/build/scene_checks.hpp"
#include "limber/scene/build/scene_robots.hpp"
#include "limber/scene/build/unused_keys.hpp"
#include "limber/scene/build/unused_settings.hpp"
#include "limber/scene/contacts/projectiles.hpp"
#include "limber/scene/contacts/support.hpp"
#include "limber/scene/contacts/touching_pairs.hpp"
#include "limber/scene/probes/stress_points.hpp"
#include "limber/scene/robot/coupler_section.hpp"
#include "limber/scene/robot/massless_links.hpp"
#include "limber/scene/scenario/scenario_reader.hpp"
#include "limber/scene/scenario/unlikely_values.hpp"
#include "limber/scene/text/toml_file.hpp"
#include "limber/scene/text/toml_settings.hpp"

namespace limber::scene {

namespace {

// For rigid links every level except rigid has no effect.
void warn_of_unused_level(dynamics::Fidelity level, Scene& scene) {
  const auto& links = scene.robot.links;
  if (level == dynamics::Fidelity::rigid ||
      std::any_of(links.begin(), links.end(),
                  [](const Link& link) { return link.flexible.has_value(); })) {
    return;
  }
  scene.scenario.warnings.push_back(fmt::format(
      "level '{}' was requested for all flexible links, but no link of '{}' is "
      "flexible: it changes nothing; give a link a <flexible> element",
      to_string(level), scene.robot.file.filename().string()));
}

void apply_overrides(const Overrides& overrides, Scene& scene) {
  if (overrides.fidelity) {
    warn_of_unused_level(*overrides.fidelity, scene);
    scene.scenario.fidelity = *overrides.fidelity;
    scene.scenario.fidelity_of_link.clear();
  }
  if (overrides.step) {
    scene.scenario.settings.step = *overrides.step;
    scene.scenario.settings.tolerance = 0.0;
    scene.scenario.settings.step_changes.clear();
  }
  if (overrides.integrator) {
    scene.scenario.settings.integrator = *overrides.integrator;
  }
  if (!overrides.rows) return;
  for (Link& link : scene.robot.links) {
    if (link.flexible) link.flexible->rows = *overrides.rows;
  }
}

// Probes of stress on links without it: an error of the file, but only a
// warning if the command line sets the level of all links.
void check_stress(const Overrides& overrides, Scene& scene) {
  Scenario& scenario = scene.scenario;
  std::vector<std::string> problems;
  const auto lacks_stress = [&](const ProbeSpec& probe) {
    const auto* stress = std::get_if<StressProbeSpec>(&probe.of);
    if (stress == nullptr) return false;
    const dynamics::Fidelity level = scenario.level_of(stress->where.link);
    if (has_stress(level)) return false;
    const std::string why =
        fmt::format("link '{}': {}", stress->where.link, explain_no_stress());
    if (overrides.fidelity) {
      scenario.warnings.push_back(
          fmt::format("probe '{}' of stress is left out: {}", probe.name, why));
    } else {
      problems.push_back(fmt::format("{}: probe '{}' on {}",
                                     scenario.file.string(), probe.name, why));
    }
    return true;
  };
  std::erase_if(scenario.probes, lacks_stress);
  if (!problems.empty()) throw InputError(problems);
}

// Problems that do not name the setting that caused them may come from any.
std::vector<std::string> name_settings(std::vector<std::string> problems,
                                       const std::vector<Setting>& settings) {
  constexpr std::size_t kMostNamed = 8;
  std::vector<std::string> texts;
  for (const Setting& setting : settings) texts.push_back(to_string(setting));
  if (texts.size() > kMostNamed) {
    texts.resize(kMostNamed);
    texts.emplace_back("...");
  }
  for (std::string& problem : problems) {
    if (problem.find("--set ") != std::string::npos ||
        problem.find("--unset ") != std::string::npos) {
      continue;
    }
    problem += fmt::format(" (with {})", fmt::join(texts, " "));
  }
  return problems;
}

// Takes the bodies that touch, and what their reductions keep for it.
void add_contacts(Scene& scene) {
  TouchingPairs touching = find_touching_pairs(scene.scenario, scene.robot);
  for (const TouchingPair& pair : touching.pairs) {
    for (const Toucher& side : {pair.A, pair.B}) {
      if (side.is_obstacle) continue;
      Link& link = scene.robot.links[side.index];
      if (!link.flexible) continue;
      link.flexible->contact_groups = find_surfaces(link);
    }
  }
  for (const std::size_t idle : touching.idle) {
    scene.scenario.warnings.push_back(fmt::format(
        "[[contact]] {} changes nothing: other [[contact]] tables take "
        "precedence for all its pairs: those that name both bodies come before "
        "those with patterns, and of these the first counts",
        idle + 1));
  }
  scene.touching = std::move(touching.pairs);
}

void note_falling(Scene& scene) {
  Scenario& scenario = scene.scenario;
  const std::vector<std::string> links =
      find_falling_links(scenario, scene.robot, scene.touching);
  if (links.empty()) return;
  const bool is_one = scenario.robots.empty();
  const std::string others =
      links.size() == 1 ? ""
                        : fmt::format(", and so do {} more", links.size() - 1);
  scenario.notes.push_back(fmt::format(
      "link '{}' falls freely, with everything attached to it{}: nothing "
      "supports it against gravity; base = \"fixed\" in {} (--set "
      "robot{}.base=fixed) fixes a robot to the world where it stands",
      links.front(), others, is_one ? "[robot]" : "its [[robot]]",
      is_one ? "" : ".NAME"));
}

Scene load(const std::filesystem::path& file, const Overrides& overrides,
           KnownRobots* known) {
  Scene scene;
  scene.overrides = overrides;
  toml::table table = parse_toml_file(file);
  const SortedSettings settings = sort_settings(overrides.settings, table);
  apply_settings(settings.scenario, table);
  scene.scenario = read_scenario(table, file);
  scene.robot = read_robots(scene.scenario, settings.robots, known);
  add_couplers(table, file, scene.robot);
  fix_massless_ends(find_used_joints(scene.scenario), scene.robot);
  add_projectiles(scene.scenario, scene.robot);
  check_scenario(scene.scenario, scene.robot);
  add_contacts(scene);
  note_falling(scene);
  choose_bases(scene.scenario, overrides.basis, scene.robot);
  apply_overrides(overrides, scene);
  check_stress(overrides, scene);
  for (std::string& text : question_scene(scene.scenario, scene.robot)) {
    scene.scenario.warnings.push_back(std::move(text));
  }
  for (std::string& text : find_unused_keys(table, scene, overrides)) {
    scene.scenario.warnings.push_back(std::move(text));
  }
  for (std::string& text : find_unused_settings(settings.robots, scene)) {
    scene.scenario.warnings.push_back(std::move(text));
  }
  return scene;
}

}  // namespace

Overrides merge(Overrides own, const Overrides& by) {
  std::erase_if(own.settings, [&](const Setting& old) {
    return std::any_of(
        by.settings.begin(), by.settings.end(),
        [&](const Setting& set) { return set.path == old.path; });
  });
  own.settings.insert(own.settings.end(), by.settings.begin(),
                      by.settings.end());
  const auto replace = [](auto& old, const auto& value) {
    if (value) old = value;
  };
  replace(own.fidelity, by.fidelity);
  replace(own.basis.eigenmodes, by.basis.eigenmodes);
  replace(own.basis.interfaces, by.basis.interfaces);
  replace(own.basis.loads, by.basis.loads);
  replace(own.basis.terms, by.basis.terms);
  replace(own.basis.pieces, by.basis.pieces);
  replace(own.step, by.step);
  replace(own.integrator, by.integrator);
  replace(own.rows, by.rows);
  return own;
}

Scene load_scene(const std::filesystem::path& file, const Overrides& overrides,
                 KnownRobots* known) {
  try {
    return load(file, overrides, known);
  } catch (const InputError& error) {
    if (overrides.settings.empty()) throw;
    throw InputError(name_settings(error.problems(), overrides.settings));
  }
}

}  // namespace limber::scene
