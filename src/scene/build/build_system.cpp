// SPDX-License-Identifier: BSD-3-Clause
#include "scene/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "scene/assembly.hpp"
#include "scene/basis_choice.hpp"
#include "scene/full_bodies.hpp"
#include "scene/link_motion.hpp"
#include "scene/naming.hpp"
#include "scene/reductions.hpp"
#include "scene/robot_reader.hpp"
#include "scene/scenario_reader.hpp"
#include "scene/scene_checks.hpp"
#include "scene/toml_file.hpp"
#include "scene/vain_keys.hpp"

namespace limber::scene {

namespace {

// Of rigid links every level but rigid is asked for in vain.
void warn_of_vain_level(dynamics::Fidelity level, Scene& scene) {
  const auto& links = scene.robot.links;
  if (level == dynamics::Fidelity::rigid ||
      std::any_of(links.begin(), links.end(),
                  [](const Link& link) { return link.flexible.has_value(); })) {
    return;
  }
  scene.scenario.warnings.push_back(fmt::format(
      "level '{}' was asked for all flexible links, but no link of '{}' is "
      "flexible: it changes nothing; give a link a <flexible> element",
      to_string(level), scene.scenario.robot.filename().string()));
}

void apply(const Overrides& overrides, Scene& scene) {
  if (overrides.fidelity) {
    warn_of_vain_level(*overrides.fidelity, scene);
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

}  // namespace

Scene load_scene(const std::filesystem::path& file,
                 const Overrides& overrides) {
  Scene scene;
  const toml::table table = parse_toml_file(file);
  scene.scenario = read_scenario(table, file);
  scene.robot = read_robot(scene.scenario.robot);
  check_scenario(scene.scenario, scene.robot);
  choose_bases(scene.scenario, overrides.basis, scene.robot);
  apply(overrides, scene);
  for (std::string& text : find_vain_keys(table, scene, overrides)) {
    scene.scenario.warnings.push_back(std::move(text));
  }
  return scene;
}

namespace {

void settle(const Scene& scene, BuiltScene& built) {
  const std::string who = "[initial] equilibrium";
  try {
    naming(who, [&] {
      built.initial =
          dynamics::find_equilibrium(built.model, built.initial,
                                     {.method = *scene.scenario.equilibrium})
              .state;
    });
  } catch (const NumericalError& error) {
    throw NumericalError(who + ": " + error.what());
  }
}

}  // namespace

BuiltScene build_system(const Scene& scene, const Reducer& reducer,
                        const std::filesystem::path& cache,
                        const FullMaker& make_full, const KnownBodies& known) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  const std::vector<LinkMotion> motions =
      find_link_motions(scene.robot, scene.scenario);
  const Reductions reductions = find_reductions(scene, reducer, cache, known);
  BodyPlans plans = plan_bodies(scene.robot, reductions.of_link);
  add_full_bodies(scene, make_full, plans);
  Assembly assembly(scene, plans, motions);
  assembly.add_bodies();
  assembly.add_couplers();
  assembly.add_loads();
  BuiltScene built;
  built.model = assembly.build();
  built.initial = assembly.make_initial_state(built.model);
  if (scene.scenario.equilibrium) settle(scene, built);
  built.probes = assembly.make_probes(built.model);
  for (Probe& probe : built.probes) {
    set_start(probe, built.model, built.initial);
  }
  built.settings = scene.scenario.settings;
  for (const auto* warnings : {&scene.robot.warnings, &scene.scenario.warnings,
                               &reductions.warnings, &assembly.warnings()}) {
    built.warnings.insert(built.warnings.end(), warnings->begin(),
                          warnings->end());
  }
  built.known = reductions.known;
  built.bodies_reduced = reductions.reduced;
  built.bodies_cached = reductions.cached;
  built.seconds_offline =
      std::chrono::duration<double>(Clock::now() - start).count();
  return built;
}

}  // namespace limber::scene
