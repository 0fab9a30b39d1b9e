// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/build/build_system.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <utility>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/common/records/manifest.hpp"
#include "limber/dynamics/analysis/elastic_band.hpp"
#include "limber/dynamics/analysis/equilibrium.hpp"
#include "limber/dynamics/analysis/natural_frequencies.hpp"
#include "limber/dynamics/analysis/steady_motion.hpp"
#include "limber/dynamics/analysis/steady_spin.hpp"
#include "limber/dynamics/equations/motion_fields.hpp"
#include "limber/dynamics/monitors/rounding_limit.hpp"
#include "limber/dynamics/newton/force_balance.hpp"
#include "limber/dynamics/system/linked_groups.hpp"
#include "limber/dynamics/system/model_check.hpp"
#include "limber/dynamics/system/model_fields.hpp"
#include "limber/scene/build/assembly.hpp"
#include "limber/scene/build/contact_assembly.hpp"
#include "limber/scene/build/link_motion.hpp"
#include "limber/scene/control/controller_assembly.hpp"
#include "limber/scene/scenario/time_settings_reader.hpp"
#include "limber/scene/text/error_context.hpp"

namespace limber::scene {

namespace {

/// Its bounding box' diagonal, or twice its radius of gyration; 0 of a body
/// that cannot move [m].
double find_size(const dynamics::BodyModel& body) {
  if (body.clamped && body.modes == 0 && body.full < 0) return 0.0;
  return body.reduced ? body.reduced->size.norm()
                      : std::sqrt(2.0 * body.J0.trace() / body.mass);
}

/// Of the size of the largest body of a linked group, which does not depend on
/// how far apart bodies are; the smallest of all groups, so that no group
/// coarsens another [m].
double choose_tolerance(const dynamics::SystemModel& model) {
  constexpr double kFraction = 1e-4;
  double smallest = kInfinity;
  for (const auto& group : dynamics::find_linked_groups(model)) {
    double largest = 0.0;
    for (const dynamics::BodyIndex b : group) {
      largest = std::max(largest, find_size(model.bodies[index(b)]));
    }
    if (largest > 0.0) smallest = std::min(smallest, largest);
  }
  return smallest < kInfinity ? kFraction * smallest : kFraction;
}

void spin(const Scene& scene, BuiltScene& built) {
  if (scene.scenario.equilibrium == dynamics::EquilibriumMethod::relaxation) {
    throw InputError(
        "relaxation is for systems at rest; this one starts with velocities");
  }
  built.initial = dynamics::find_steady_spin(built.model, built.initial);
}

/// How fast a disturbance of an equilibrium or a steady rotation grows
/// [1/s]; 0 if it does not, or is not computed.
double find_growth(const BuiltScene& built) {
  constexpr int kMostAtRest = 600;  // unknowns, of dense matrices
  constexpr int kMostMoving = 200;
  constexpr double kRoundoff = 1e-6;  // of the fastest motion
  const dynamics::SystemModel& model = built.model;
  const int unknowns =
      6 * static_cast<int>(model.bodies.size()) + model.modal_count;
  const bool is_moving = dynamics::moves(built.initial);
  if (model.nodal_count > 0 || !model.pairs.empty() ||
      unknowns > (is_moving ? kMostMoving : kMostAtRest)) {
    return 0.0;
  }
  if (!is_moving) {
    const VectorX all = find_natural_frequencies(model, built.initial);
    if (all.size() == 0 || all[0] >= 0.0) return 0.0;
    return 2.0 * std::numbers::pi * -all[0];
  }
  double fastest = 0.0;
  double growth = 0.0;
  for (const auto& mode : find_natural_modes(model, built.initial).modes) {
    fastest = std::max(fastest, std::abs(mode.value));
    growth = std::max(growth, mode.value.real());
  }
  return growth > kRoundoff * fastest ? growth : 0.0;
}

/// Controllers may hold what is unstable without them.
void warn_of_growth(const Scene& scene, BuiltScene& built) {
  if (!scene.scenario.controllers.empty()) return;
  const double growth = find_growth(built);
  if (growth == 0.0) return;
  built.warnings.push_back(fmt::format(
      "[initial] equilibrium: the {} that was found is unstable: a disturbance "
      "grows as exp({:.3g} t / s)",
      dynamics::moves(built.initial) ? "steady rotation" : "equilibrium",
      growth));
}

void settle(const Scene& scene, BuiltScene& built) {
  const std::string who = "[initial] equilibrium";
  try {
    with_context(who, [&] {
      if (dynamics::moves(built.initial)) {
        spin(scene, built);
        return;
      }
      built.initial =
          dynamics::find_equilibrium(built.model, built.initial,
                                     {.method = *scene.scenario.equilibrium})
              .state;
    });
  } catch (const NumericalError& error) {
    throw NumericalError(who + ": " + error.what());
  }
}

bool has_loss_factor(const Scene& scene) {
  return std::any_of(scene.robot.links.begin(), scene.robot.links.end(),
                     [](const Link& link) {
                       return link.flexible && link.flexible->loss_factor > 0.0;
                     });
}

/// What bands depend on; reduced bodies are the same if they are one object.
KnownBands describe_bands(dynamics::SystemModel model,
                          const dynamics::SystemState& state) {
  KnownBands known;
  for (dynamics::BodyModel& body : model.bodies) {
    known.bodies.push_back(std::exchange(body.reduced, nullptr));
  }
  Manifest manifest;
  describe(manifest, "system", model);
  describe(manifest, "state", dynamics::stop(state));
  known.system = manifest.text();
  return known;
}

/// The bands of frequencies at the scene's start which its links' loss factors
/// hold in, one per body; the same at all levels. Without loss factors none.
/// @param known the newest first; that of this scene is put there
ElasticBands find_bands(const Scene& scene, BodyPlans plans,
                        const std::vector<LinkMotion>& motions,
                        std::vector<KnownBands>& known) {
  constexpr std::size_t kMostKnown = 8;
  if (!has_loss_factor(scene)) return {};
  for (BodyPlan& plan : plans.bodies) plan.full.reset();
  Assembly assembly(scene, plans, motions, std::nullopt);
  assembly.add_bodies();
  assembly.add_inputs();
  assembly.add_couplers();
  const dynamics::SystemModel model = assembly.build();
  const dynamics::SystemState state = assembly.make_initial_state(model);
  KnownBands now = describe_bands(model, state);
  const auto same =
      std::find_if(known.begin(), known.end(), [&](const KnownBands& one) {
        return one.bodies == now.bodies && one.system == now.system;
      });
  if (same != known.end()) return same->bands;
  now.bands = dynamics::find_elastic_bands(model, state);
  known.insert(known.begin(), now);
  if (known.size() > kMostKnown) known.pop_back();
  return now.bands;
}

}  // namespace

BuiltScene build_system(const Scene& scene, const Reducer& reducer,
                        const std::filesystem::path& cache,
                        const FullMaker& make_full, const KnownParts& known) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  const std::vector<LinkMotion> motions =
      find_link_motions(scene.robot, scene.scenario);
  const Reductions reductions =
      find_reductions(scene, reducer, cache, known.bodies);
  BodyPlans plans = plan_bodies(scene.robot, reductions.of_link);
  add_full_bodies(scene, make_full, plans);
  std::vector<KnownBands> bands = known.bands;
  Assembly assembly(scene, plans, motions,
                    find_bands(scene, plans, motions, bands));
  assembly.add_bodies();
  assembly.add_inputs();
  assembly.add_couplers();
  assembly.add_loads();
  assembly.add_contacts();
  BuiltScene built;
  built.model = assembly.build();
  built.initial = assembly.make_initial_state(built.model);
  dynamics::check_rounding(built.model, built.initial);
  assembly.check_start(built.model, built.initial);
  if (scene.scenario.equilibrium) {
    settle(scene, built);
    warn_of_growth(scene, built);
  }
  built.probes = assembly.make_probes(built.model);
  for (Probe& probe : built.probes) {
    set_start(probe, built.model, built.initial);
  }
  built.model = dynamics::with_controllers(
      std::move(built.model), make_controllers(scene.scenario, built.probes));
  built.initial.controllers = dynamics::make_state(built.model).controllers;
  for (int link = 0; link < std::ssize(scene.robot.links); ++link) {
    built.links.push_back(assembly.place_link(link));
  }
  built.settings = scene.scenario.settings;
  if (built.settings.tolerance == kToleranceToChoose) {
    built.settings.tolerance = choose_tolerance(built.model);
  }
  for (const auto* warnings : {&scene.robot.warnings, &scene.scenario.warnings,
                               &reductions.warnings, &assembly.warnings()}) {
    built.warnings.insert(built.warnings.end(), warnings->begin(),
                          warnings->end());
  }
  built.notes = scene.scenario.notes;
  built.notes.insert(built.notes.end(), reductions.found.begin(),
                     reductions.found.end());
  built.notes.insert(built.notes.end(), assembly.notes().begin(),
                     assembly.notes().end());
  built.piece_checks = reductions.piece_checks;
  built.known = {reductions.known, std::move(bands)};
  built.bodies_reduced = reductions.reduced;
  built.bodies_cached = reductions.cached;
  built.seconds_offline =
      std::chrono::duration<double>(Clock::now() - start).count();
  return built;
}

}  // namespace limber::scene
