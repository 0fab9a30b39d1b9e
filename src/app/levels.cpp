// SPDX-License-Identifier: BSD-3-Clause
#include "app/levels.hpp"

#include <fmt/format.h>

#include <map>

#include "app/reducer.hpp"
#include "flexbody/cache.hpp"

namespace limber::app {
namespace {

using dynamics::Fidelity;
using dynamics::SystemModel;

/// Bodies that `model` has are not reduced again, whatever the cache holds.
scene::Reducer make_known_reducer(const SystemModel& model) {
  return [&model](const flexbody::Recipe& recipe) {
    const std::string key = flexbody::content_key(recipe);
    for (const dynamics::BodyModel& body : model.bodies) {
      if (!body.reduced || body.reduced->content_key != key) continue;
      flexbody::ReducedBody known = *body.reduced;
      known.name = recipe.name;
      return known;
    }
    return make_reducer({})(recipe);
  };
}

bool has_all_modes(const SystemModel& model) {
  for (const dynamics::BodyModel& body : model.bodies) {
    if (body.reduced && body.modes != body.reduced->mode_count()) return false;
  }
  return true;
}

/// The run's model with every flexible body at `uncoupled`.
SystemModel find_flexible_model(const scene::Scene& scene,
                                const scene::BuiltScene& built,
                                const std::filesystem::path& cache) {
  if (!has_all_modes(built.model)) {
    return build_at_level(scene, Fidelity::uncoupled, built.model, cache).model;
  }
  SystemModel model = built.model;
  for (dynamics::BodyModel& body : model.bodies) {
    if (body.reduced) body.fidelity = Fidelity::uncoupled;
  }
  return model;
}

}  // namespace

scene::BuiltScene build_at_level(const scene::Scene& scene, Fidelity level,
                                 const SystemModel& model,
                                 const std::filesystem::path& cache) {
  scene::Scene same = scene;
  // The rows that level full had them keep: so nothing is reduced again.
  for (scene::Link& link : same.robot.links) {
    if (link.flexible && scene.scenario.level_of(link.name) == Fidelity::full) {
      link.flexible->rows = flexbody::parse_rows({"all"});
    }
  }
  same.scenario.fidelity = level;
  same.scenario.fidelity_of_link.clear();
  return scene::build_system(
      same, make_known_reducer(model),
      cache.empty() ? flexbody::default_cache_folder() : cache);
}

std::vector<BodyLevel> judge_levels(const SystemModel& model,
                                    const dynamics::LevelSurvey& survey,
                                    const std::vector<Fidelity>& used,
                                    const dynamics::AdviceSettings& settings) {
  std::vector<BodyLevel> levels;
  auto tracks = survey.tracks();
  for (const dynamics::BodyPeaks& peaks : survey.find_peaks()) {
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

std::vector<BodyLevel> judge_run(const scene::Scene& scene,
                                 const scene::BuiltScene& built,
                                 const results::History& history,
                                 const std::filesystem::path& cache) {
  std::vector<Fidelity> used;
  bool is_flexible = false;
  for (const dynamics::BodyModel& body : built.model.bodies) {
    used.push_back(body.fidelity);
    is_flexible |= body.reduced != nullptr;
  }
  if (!is_flexible) return {};
  const SystemModel model = find_flexible_model(scene, built, cache);
  dynamics::LevelSurvey survey(model);
  for (const dynamics::SystemState& state : history.states) {
    survey.include(built.model, state);
  }
  return judge_levels(model, survey, used, scene.scenario.advice);
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
    if (level.advice.is_beyond_linear) {
      warnings.push_back(fmt::format(
          "link '{}' deforms by {:.2g} m, beyond the linear limit of {:.2g} "
          "m: no level is right",
          level.name, level.peaks.deformation, level.limits.linear_limit));
    }
  }
  return warnings;
}

}  // namespace limber::app
