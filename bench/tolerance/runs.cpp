// SPDX-License-Identifier: BSD-3-Clause
#include "runs.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>

#include "limber/app/options/reducer.hpp"
#include "limber/common/errors.hpp"
#include "limber/scene/build/load_scene.hpp"

namespace limber::bench::tolerance {
namespace {

constexpr int kOutputs = 100;
// Of the smallest tolerance: where a reference is good enough.
constexpr double kFine = 0.02;
constexpr double kMostSeconds = 1.5;  // of the finest rung

scene::BuiltScene build(const std::string& file,
                        const std::filesystem::path& cache) {
  const scene::Scene scene =
      scene::load_scene(std::string(LIMBER_SOURCE_DIR "/") + file,
                        {.fidelity = dynamics::Fidelity::coupled});
  scene::BuiltScene built =
      scene::build_system(scene, app::make_reducer({}), cache);
  const double start = built.initial.t;
  const double span = built.settings.end_time - start;
  built.settings.output_times.clear();
  for (int i = 0; i <= kOutputs; ++i) {
    built.settings.output_times.push_back(start + span * i / kOutputs);
  }
  built.settings.output_times.back() = built.settings.end_time;
  return built;
}

}  // namespace

SceneRuns::SceneRuns(const std::string& file,
                     const std::filesystem::path& cache)
    : name_(file), built_(build(file, cache)), scale_(built_.model) {}

double SceneRuns::span() const {
  return built_.settings.end_time - built_.initial.t;
}

double SceneRuns::own_step() const {
  double longest = built_.settings.step;
  for (const dynamics::StepChange& change : built_.settings.step_changes) {
    longest = std::max(longest, change.step);
  }
  return longest;
}

Run SceneRuns::run(const dynamics::SimulationSettings& settings) const {
  Run run;
  dynamics::SystemState state = built_.initial;
  const auto observe = [&](const dynamics::SystemState& at,
                           const dynamics::EnergyBalance&) {
    run.states.push_back(at);
  };
  const std::clock_t begin = std::clock();
  try {
    dynamics::simulate(built_.model, state, settings, observe, {},
                       run.statistics);
  } catch (const NumericalError& error) {
    run.stopped = error.what();
  }
  run.seconds =
      static_cast<double>(std::clock() - begin) / double{CLOCKS_PER_SEC};
  return run;
}

Run SceneRuns::run_to(double tolerance,
                      dynamics::TolerancePasses passes) const {
  dynamics::SimulationSettings settings = built_.settings;
  settings.step = span();
  settings.step_changes.clear();
  settings.tolerance = tolerance;
  settings.passes = passes;
  return run(settings);
}

Run SceneRuns::run_fixed(double step) const {
  dynamics::SimulationSettings settings = built_.settings;
  settings.step = step;
  settings.step_changes.clear();
  settings.tolerance = 0.0;
  return run(settings);
}

Run SceneRuns::run_own_steps(double longest) const {
  dynamics::SimulationSettings settings = built_.settings;
  const double factor = longest / own_step();
  settings.step *= factor;
  for (dynamics::StepChange& change : settings.step_changes) {
    change.step *= factor;
  }
  settings.tolerance = 0.0;
  return run(settings);
}

double SceneRuns::measure_distance(const Run& a, const Run& b) const {
  if (!a.stopped.empty() || !b.stopped.empty()) return INFINITY;
  double largest = 0.0;
  for (std::size_t i = 0; i < a.states.size(); ++i) {
    largest = std::max(
        largest,
        scale_.measure_distance(a.states[i], b.states.at(i)).displacement);
  }
  return largest;
}

double SceneRuns::measure_motion(const Run& run) const {
  double largest = 0.0;
  for (const dynamics::SystemState& state : run.states) {
    largest = std::max(
        largest, scale_.measure_distance(built_.initial, state).displacement);
  }
  return largest;
}

Reference find_reference(const SceneRuns& runs, double smallest) {
  Reference reference;
  std::vector<Rung>& ladder = reference.ladder;
  double uncertainty = INFINITY;
  for (double step = runs.span() / kOutputs;; step *= 0.5) {
    ladder.push_back({step, runs.run_fixed(step), INFINITY});
    if (ladder.size() < 2) continue;
    // Of a second-order scheme.
    uncertainty = runs.measure_distance(ladder[ladder.size() - 2].run,
                                        ladder.back().run) /
                  3.0;
    if (uncertainty < kFine * smallest ||
        ladder.back().run.seconds > kMostSeconds) {
      break;
    }
  }
  const Run free =
      runs.run_to(kFine * smallest, dynamics::TolerancePasses::verified);
  const double free_uncertainty =
      free.stopped.empty() ? free.statistics.estimated_error : INFINITY;
  reference.from_other = runs.measure_distance(free, ladder.back().run);
  if (uncertainty <= free_uncertainty) {
    reference.run = ladder.back().run;
    reference.kind = "fixed";
    reference.uncertainty = uncertainty;
    reference.other_uncertainty = free_uncertainty;
  } else {
    reference.run = free;
    reference.kind = "tolerance";
    reference.uncertainty = free_uncertainty;
    reference.other_uncertainty = uncertainty;
  }
  for (Rung& rung : ladder) {
    rung.error = runs.measure_distance(rung.run, reference.run);
  }
  return reference;
}

}  // namespace limber::bench::tolerance
