// SPDX-License-Identifier: BSD-3-Clause
#include "limber/runs/level_judgement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "limber/common/errors.hpp"
#include "limber/dynamics/simulation/run_record.hpp"
#include "limber/dynamics/terms/mean_frame.hpp"
#include "limber/runs/numbered_stages.hpp"
#include "limber/runs/unused_cache.hpp"
#include "limber/scene/build/build_system.hpp"
#include "limber/scene/build/recipes.hpp"

namespace limber::runs {
namespace {

using dynamics::Fidelity;
using dynamics::SystemModel;

bool has_flexible_body(const SystemModel& model) {
  return std::any_of(
      model.bodies.begin(), model.bodies.end(),
      [](const dynamics::BodyModel& body) { return body.reduced != nullptr; });
}

bool has_all_modes(const SystemModel& model) {
  for (const dynamics::BodyModel& body : model.bodies) {
    if (body.reduced && body.modes != body.reduced->mode_count()) return false;
  }
  return true;
}

bool touches(const SystemModel& model, dynamics::BodyIndex body) {
  return std::any_of(model.pairs.begin(), model.pairs.end(),
                     [&](const dynamics::Pair& pair) {
                       return pair.body_A == body || pair.body_B == body;
                     });
}

/// Every flexible body at `uncoupled`, or at `nonlinear` with linear elasticity
/// if products of modes move its contact surfaces.
SystemModel lower_levels(SystemModel model) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    dynamics::BodyModel& body = model.bodies[b];
    if (!body.reduced) continue;
    if (body.fidelity == Fidelity::nonlinear) {
      body.elasticity =
          flexbody::DiagonalStiffness(flexbody::DiagonalStiffness::Parameters{
              body.maxwell.scale * body.reduced->lambda});
      if (touches(model, static_cast<dynamics::BodyIndex>(b))) continue;
    }
    body.fidelity = Fidelity::uncoupled;
  }
  return model;
}

/// Levels of links that may be in pieces, and are then the same bodies in both
/// models.
std::map<std::string, Fidelity> find_cut_links(const scene::Scene& scene) {
  std::map<std::string, Fidelity> levels;
  for (const scene::Link& link : scene.robot.links) {
    const Fidelity level = scene.scenario.level_of(link.name);
    if (!link.flexible || link.flexible->pieces == 1) continue;
    if (scene::takes_pieces(level)) levels[link.name] = level;
  }
  return levels;
}

/// The run's model with every flexible body at `uncoupled`.
SystemModel find_flexible_model(const scene::Scene& scene,
                                const scene::BuiltScene& built,
                                const Reductions& reductions) {
  if (!has_all_modes(built.model)) {
    scene::Scene at_start = scene;
    at_start.scenario.equilibrium.reset();
    return lower_levels(build_at_level(at_start, Fidelity::uncoupled,
                                       built.known, reductions,
                                       find_cut_links(scene))
                            .model);
  }
  return lower_levels(built.model);
}

void require_flexible_link(const scene::Scene& scene) {
  for (const scene::Link& link : scene.robot.links) {
    if (link.flexible) return;
  }
  throw InputError(
      fmt::format("{}: no link is flexible; there is no level to choose",
                  scene.robot.file.string()));
}

bool is_of_stress(const scene::ProbeSpec& probe) {
  return std::holds_alternative<scene::StressProbeSpec>(probe.of);
}

/// The scene without what a rigid link does not have.
/// @throws InputError if a controller measures it
scene::Scene leave_out_stress(scene::Scene scene) {
  scene::Scenario& scenario = scene.scenario;
  for (const scene::ProbeSpec& probe : scenario.probes) {
    if (!is_of_stress(probe)) continue;
    for (const scene::ControllerSpec& controller : scenario.controllers) {
      const auto is_of = [&](const std::string& column) {
        return column.starts_with(probe.name + ".");
      };
      if (!is_of(controller.measures) && !is_of(controller.rate)) continue;
      throw InputError(fmt::format(
          "{}: controller '{}' measures the stress '{}', which the rigid links "
          "of this first run do not have: no level can be advised",
          scenario.file.string(), controller.name, probe.name));
    }
  }
  std::erase_if(scenario.probes, is_of_stress);
  scenario.output.stress = false;
  return scene;
}

/// The levels that the scenario requests, one per body.
std::vector<dynamics::Fidelity> find_requested(
    const scene::Scenario& scenario, const dynamics::SystemModel& model) {
  std::vector<dynamics::Fidelity> requested;
  for (const dynamics::BodyModel& body : model.bodies) {
    const auto found = scenario.fidelity_of_link.find(body.name);
    requested.push_back(found == scenario.fidelity_of_link.end()
                            ? scenario.fidelity
                            : found->second);
  }
  return requested;
}

/// Forces of an impact are those of the masses that meet, which for flexible
/// links are smaller, and what happens after it may differ.
std::string find_doubt(const std::vector<dynamics::ContactRecord>& contacts) {
  if (contacts.empty()) return "";
  return fmt::format(
      "these figures may not apply: the run of rigid links has {} contacts, "
      "the first {} at {:.4g} s, and flexible links change their forces; use "
      "the levels that 'limber run' reports",
      contacts.size(), contacts.front().pair, contacts.front().time);
}

}  // namespace

scene::BuiltScene build_at_level(
    const scene::Scene& scene, Fidelity level, const scene::KnownParts& known,
    const Reductions& reductions,
    const std::map<std::string, Fidelity>& others) {
  scene::Scene same = scene;
  // The same rows as for level `full`, so that nothing is reduced again.
  for (scene::Link& link : same.robot.links) {
    if (link.flexible && scene.scenario.level_of(link.name) == Fidelity::full) {
      link.flexible->rows = flexbody::parse_rows({"all"});
    }
  }
  same.scenario.fidelity = level;
  same.scenario.fidelity_of_link = others;
  return scene::build_system(same, reductions.reducer, reductions.cache, {},
                             known);
}

std::vector<BodyLevel> judge_levels(
    const SystemModel& model, const dynamics::LevelObserver& level_observer,
    const std::vector<Fidelity>& used,
    const dynamics::AdviceSettings& settings) {
  std::vector<BodyLevel> levels;
  auto tracks = level_observer.tracks();
  for (const dynamics::BodyPeaks& peaks : level_observer.find_peaks()) {
    const auto b = static_cast<std::size_t>(peaks.body);
    const dynamics::BodyModel& body = model.bodies[b];
    BodyLevel level;
    level.name = body.name;
    level.used = used[b];
    level.peaks = peaks;
    level.limits = dynamics::find_limits(settings, *body.reduced);
    level.advice = dynamics::advise(body, peaks, level.limits);
    level.reduced = body.reduced;
    level.track = std::move(tracks[levels.size()]);
    levels.push_back(std::move(level));
  }
  return levels;
}

RunLevelObserver::RunLevelObserver(const scene::Scene& scene,
                                   const scene::BuiltScene& built,
                                   const Reductions& reductions)
    : scene_(scene), built_(built) {
  if (!has_flexible_body(built.model)) return;
  model_ = find_flexible_model(scene, built, reductions);
  level_observer_.emplace(model_);
}

std::optional<dynamics::MotionObserver>
RunLevelObserver::make_motion_observer() {
  if (!level_observer_) return std::nullopt;
  return dynamics::MotionObserver{
      [this] { level_observer_.emplace(model_); },
      [this](const dynamics::SystemState& state) { include(state); },
      [this](Archive& archive) { level_observer_->exchange_memory(archive); }};
}

void RunLevelObserver::include(const dynamics::SystemState& state) {
  if (!level_observer_) return;
  if (built_.model.full_bodies.empty()) {
    level_observer_->include(built_.model, state);
    return;
  }
  framed_ = state;
  dynamics::update_mean_frames(built_.model, framed_);
  level_observer_->include(built_.model, framed_);
}

std::vector<BodyLevel> RunLevelObserver::judge() const {
  if (!level_observer_) return {};
  std::vector<Fidelity> used;
  for (const dynamics::BodyModel& body : built_.model.bodies) {
    used.push_back(body.fidelity);
  }
  return judge_levels(model_, *level_observer_, used, scene_.scenario.advice);
}

SceneAdvice advise_scene(const scene::Scene& scene,
                         const Reductions& reductions,
                         const Progress& progress) {
  require_flexible_link(scene);
  scene::Scene flexible_scene = scene;
  flexible_scene.scenario.fidelity = dynamics::Fidelity::uncoupled;
  flexible_scene.scenario.fidelity_of_link.clear();
  flexible_scene.scenario.equilibrium.reset();
  scene::BuiltScene flexible =
      scene::build_system(flexible_scene, reductions.reducer, reductions.cache);
  warn_of_unused_cache(reductions.cache, flexible);
  const scene::BuiltScene rigid =
      build_at_level(leave_out_stress(scene), dynamics::Fidelity::rigid,
                     flexible.known, reductions);
  std::optional<dynamics::LevelObserver> level_observer(flexible.model);
  dynamics::Followed followed;
  followed.motion_observer = {[&] { level_observer.emplace(flexible.model); },
                              [&](const dynamics::SystemState& now) {
                                level_observer->include(rigid.model, now);
                              },
                              {}};
  dynamics::SimulationSettings settings = rigid.settings;
  settings.output_times.clear();
  dynamics::SystemState state = rigid.initial;
  dynamics::SimulationStatistics statistics;
  dynamics::RunRecord record;
  dynamics::simulate(rigid.model, state, settings, {},
                     number_stage(progress, 2, 2), statistics, {}, followed,
                     record);
  SceneAdvice advice{
      scene.scenario.file.string(),
      judge_levels(flexible.model, *level_observer,
                   find_requested(scene.scenario, flexible.model),
                   scene.scenario.advice),
      flexible.warnings, flexible.notes};
  advice.warnings.insert(advice.warnings.end(), statistics.warnings.begin(),
                         statistics.warnings.end());
  find_bounds(advice.levels);
  const std::string doubt = find_doubt(record.contacts);
  for (BodyLevel& level : advice.levels) level.doubt = doubt;
  for (const dynamics::ImpactSpectrum& spectrum :
       dynamics::find_impact_spectra(flexible.model, record.contacts)) {
    for (BodyLevel& level : advice.levels) {
      if (level.name == spectrum.body) level.impacts.push_back(spectrum);
    }
  }
  return advice;
}

void find_bounds(std::vector<BodyLevel>& levels) {
  using Bound = flexbody::InertialDisplacementBound;
  std::map<const flexbody::ReducedBody*, std::shared_ptr<const Bound>> known;
  for (BodyLevel& level : levels) {
    if (level.reduced->clamped || level.reduced->mode_count() == 0) continue;
    auto& bound = known[level.reduced.get()];
    if (!bound) bound = std::make_shared<const Bound>(*level.reduced);
    level.bound = bound;
  }
}

std::vector<std::string> find_level_warnings(
    const std::vector<BodyLevel>& levels) {
  std::vector<std::string> warnings;
  for (const BodyLevel& level : levels) {
    if (level.used < level.advice.level) {
      warnings.push_back(fmt::format("link '{}' was {}; {} is needed: {}",
                                     level.name, to_string(level.used),
                                     to_string(level.advice.level),
                                     level.advice.reason));
    }
  }
  return warnings;
}

}  // namespace limber::runs
