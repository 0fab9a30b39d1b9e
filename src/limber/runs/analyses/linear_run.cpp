// SPDX-License-Identifier: BSD-3-Clause
#include "limber/runs/analyses/linear_run.hpp"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "limber/common/errors.hpp"
#include "limber/common/parse_number.hpp"
#include "limber/dynamics/analysis/equilibrium.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/runs/analyses/linearised_at.hpp"
#include "limber/runs/unused_cache.hpp"
#include "limber/scene/build/build_system.hpp"
#include "limber/scene/control/closed_loop.hpp"

namespace limber::runs {
namespace {

/// The state that the model's deviations refer to.
struct ReferenceState {
  dynamics::SystemState state;
  std::string about;  ///< "start", "equilibrium", "time"
  std::string where;  ///< in a sentence
};

/// The state of the scene's run at a time.
dynamics::SystemState run_to(double t, const scene::BuiltScene& built,
                             const Progress& progress) {
  dynamics::SystemState state = built.initial;
  dynamics::SimulationSettings settings = built.settings;
  if (!(t >= state.t && t <= settings.end_time)) {
    throw InputError(fmt::format(
        "a linear model about {:g} s: the run goes from {:g} s to {:g} s", t,
        state.t, settings.end_time));
  }
  if (t == state.t) return state;
  settings.end_time = t;
  settings.output_times = {t};
  std::erase_if(settings.step_changes, [&](const dynamics::StepChange& change) {
    return change.from >= t;
  });
  simulate(
      built.model, state, settings, [](const auto&, const auto&) {}, progress);
  return state;
}

ReferenceState find_reference(const std::variant<Reference, double>& at,
                              const scene::Scene& scene,
                              const scene::BuiltScene& built,
                              const Progress& progress) {
  if (const double* t = std::get_if<double>(&at)) {
    return {run_to(*t, built, progress), "time",
            fmt::format("the state at {:g} s", *t)};
  }
  if (std::get<Reference>(at) == Reference::start) {
    return {built.initial, scene.scenario.equilibrium ? "equilibrium" : "start",
            "the start"};
  }
  return {find_equilibrium(built.model, built.initial,
                           {.method = scene.scenario.equilibrium.value_or(
                                dynamics::EquilibriumMethod::newton)},
                           progress)
              .state,
          "equilibrium", "the equilibrium"};
}

void add_linear_warnings(const std::string& where, LinearRun& run) {
  const dynamics::LinearSystem& system = run.linear.system;
  const LinearisedAt at{where, "the model is"};
  std::vector<std::string>& warnings = run.record.warnings;
  if (system.imbalance.matters) {
    warnings.push_back(
        describe_imbalance(system.imbalance, system.is_moving, at));
  }
  if (system.change > kReportedChange) {
    warnings.push_back(describe_change(system.change, at));
  }
  const auto& more = run.linear.warnings;
  warnings.insert(warnings.end(), more.begin(), more.end());
}

void truncate(int states, LinearRun& run) {
  results::LinearRecord& record = run.record;
  run.truncated = dynamics::truncate_balanced(run.linear.model, states);
  record.model = run.truncated->model;
  record.hankel.assign(run.truncated->hankel.begin(),
                       run.truncated->hankel.end());
  record.bound = run.truncated->bound;
  const Eigen::Index left = record.model.A.rows();
  if (left == states) return;
  record.warnings.push_back(
      fmt::format("the model has {} states in place of {}; the contribution of "
                  "the others from inputs to outputs is below round-off",
                  left, states));
}

void close_loops(const LinearRequest& request,
                 const dynamics::SystemModel& model, LinearRun& run) {
  const scene::LinearSelection& selection = request.selection;
  if (!selection.inputs.empty() || !selection.outputs.empty() ||
      request.states > 0) {
    throw InputError(
        "the closed loop has all inputs, outputs and states; leave out their "
        "selection and number");
  }
  if (model.controllers.empty()) {
    throw InputError("a closed loop needs a [[controller]]; there is none");
  }
  const scene::ClosedLoop loop = scene::find_closed_loop(model, run.linear);
  dynamics::SampledLoop sampled(*loop.plant, loop.controllers);
  run.record.model = sampled.find_model();
  run.record.period = sampled.period();
  if (const auto unstable = sampled.find_instability()) {
    run.record.warnings.push_back(
        scene::describe_instability(model, loop, *unstable));
  }
  run.linear.open_loops.clear();
}

}  // namespace

std::variant<Reference, double> parse_reference(const std::string& text) {
  if (text == "start") return Reference::start;
  if (text == "equilibrium") return Reference::equilibrium;
  if (const std::optional<double> time = parse_number(text)) return *time;
  throw InputError(
      fmt::format("a linear model about '{}': expected 'start', 'equilibrium' "
                  "or a time of the run in seconds",
                  text));
}

LinearRun linearise_scene(const scene::Scene& scene,
                          const LinearRequest& request,
                          const Reductions& reductions,
                          const Progress& progress) {
  scene::BuiltScene built = scene::build_system(
      scene, reductions.reducer, reductions.cache, reductions.make_full);
  warn_of_unused_cache(reductions.cache, built);
  const ReferenceState reference =
      find_reference(request.at, scene, built, progress);
  LinearRun run;
  run.linear = scene::linearise(scene.scenario, built.model, reference.state,
                                built.probes, request.selection);
  run.record.warnings = built.warnings;
  run.notes = built.notes;
  add_linear_warnings(reference.where, run);
  run.record.model = run.linear.model;
  if (request.closes_loops) {
    close_loops(request, built.model, run);
  } else if (request.states > 0) {
    truncate(request.states, run);
  }
  const Vector3& w = run.linear.system.axes.w_W;
  run.record.axes_angular_velocity = {w.x(), w.y(), w.z()};
  run.record.time = reference.state.t;
  run.record.scenario = scene.scenario.name;
  run.record.about = reference.about;
  return run;
}

}  // namespace limber::runs
