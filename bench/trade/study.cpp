// SPDX-License-Identifier: BSD-3-Clause
#include "study.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "limber/app/options/reducer.hpp"
#include "limber/common/errors.hpp"
#include "limber/dynamics/equations/node_motion.hpp"
#include "limber/results/energy_error.hpp"
#include "limber/runs/compare/comparison.hpp"
#include "limber/runs/timed_reducer.hpp"
#include "limber/scene/build/load_scene.hpp"

namespace limber::bench::trade {
namespace {

using Clock = std::chrono::steady_clock;

double read_seconds(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

scene::Scene load(const std::filesystem::path& file, const Choice& choice) {
  scene::Overrides overrides;
  overrides.fidelity = choice.level;
  overrides.basis = choice.basis;
  overrides.rows = flexbody::KeptRows{flexbody::KeptRows::Extent::all, {}};
  if (choice.step > 0.0) overrides.step = choice.step;
  scene::Scene scene = scene::load_scene(file, overrides);
  scene.scenario.fidelity_of_link = choice.links;
  scene.scenario.full = choice.full;
  scene.scenario.settings.integrator = choice.integrator;
  scene.scenario.settings.exact_modes = choice.exact_modes;
  if (choice.change) choice.change(scene);
  return scene;
}

Pose find_start(const Outcome& outcome, int b) {
  const auto& body =
      outcome.run.built.initial.bodies[static_cast<std::size_t>(b)];
  return {body.quat_WB.toRotationMatrix(), body.p_WB};
}

MatrixX make_room(const Outcome& outcome, int b) {
  const auto& body =
      outcome.run.built.model.bodies[static_cast<std::size_t>(b)];
  return {body.reduced->rows.x_B.size(),
          std::ssize(outcome.run.history.states)};
}

/// What a user pays who wants every node in the world at every output.
double time_nodes(const Outcome& outcome) {
  const Clock::time_point start = Clock::now();
  const auto& bodies = outcome.run.built.model.bodies;
  for (int b = 0; b < std::ssize(bodies); ++b) {
    if (bodies[static_cast<std::size_t>(b)].reduced) {
      (void)find_displacement(outcome, b);
    }
  }
  return read_seconds(start);
}

void find_cost(Outcome& outcome) {
  const runs::Run& run = outcome.run;
  double least = run.statistics.seconds;
  double total = least;
  double nodes = time_nodes(outcome);
  const auto is_enough = [&](int count) {
    if (outcome.choice.repeats > 0) return count >= outcome.choice.repeats;
    return total >= runs::kEnough;
  };
  for (int count = 1; !is_enough(count); ++count) {
    const double seconds = runs::repeat_timing(run, {});
    least = std::min(least, seconds);
    total += seconds;
    if (count < 10) nodes = std::min(nodes, time_nodes(outcome));
  }
  const double end = run.scene.scenario.settings.end_time;
  outcome.online = least / end;
  outcome.with_nodes = (least + nodes) / end;
}

std::string find_reason(const std::exception_ptr& failure) {
  try {
    std::rethrow_exception(failure);
  } catch (const NumericalError& error) {
    return error.what();
  }
}

}  // namespace

Study::Study(const std::string& scene, std::filesystem::path cache)
    : file_(std::filesystem::path(LIMBER_SOURCE_DIR) / "bench/trade/scenes" /
            (scene + ".toml")),
      cache_(std::move(cache)) {}

const Outcome& Study::add_reference(const Choice& choice) {
  LIMBER_EXPECT(outcomes_.empty());
  outcomes_.push_back(std::make_unique<Outcome>(simulate(choice)));
  return reference();
}

const Outcome& Study::add(const Choice& choice) {
  outcomes_.push_back(std::make_unique<Outcome>(simulate(choice)));
  Outcome& outcome = *outcomes_.back();
  if (!outcome.stopped.empty()) return outcome;
  outcome.error = results::calc_motion_error(
      {outcome.run.built.model, outcome.run.history.states},
      {reference().run.built.model, reference().run.history.states});
  return outcome;
}

std::vector<const Outcome*> Study::list() const {
  std::vector<const Outcome*> outcomes;
  for (std::size_t i = 1; i < outcomes_.size(); ++i) {
    outcomes.push_back(outcomes_[i].get());
  }
  return outcomes;
}

const Outcome& Study::find(const std::string& name) const {
  for (const auto& outcome : outcomes_) {
    if (outcome->choice.name == name) return *outcome;
  }
  throw InputError("no run '" + name + "' in this study");
}

Outcome Study::simulate(const Choice& choice) const {
  Outcome outcome;
  outcome.choice = choice;
  const scene::Reducer reducer = runs::time_reductions(
      app::make_reducer({}),
      [&](const std::string&, double seconds) { outcome.offline += seconds; });
  outcome.run = runs::simulate_scene(load(file_, choice),
                                     {.reductions = {reducer, cache_}});
  if (outcome.run.failure) {
    outcome.stopped = find_reason(outcome.run.failure);
    return outcome;
  }
  outcome.drift =
      results::find_energy_error(outcome.run.history).relative_largest();
  find_cost(outcome);
  return outcome;
}

MatrixX find_deformation(const Outcome& outcome, int b) {
  MatrixX u = make_room(outcome, b);
  const results::States& states = outcome.run.history.states;
  dynamics::calc_node_deformations(outcome.run.built.model,
                                   dynamics::BodyIndex(b),
                                   states.read(0, states.size()), u);
  return u;
}

MatrixX find_displacement(const Outcome& outcome, int b) {
  MatrixX u = make_room(outcome, b);
  const results::States& states = outcome.run.history.states;
  dynamics::calc_node_displacements(
      outcome.run.built.model, dynamics::BodyIndex(b),
      states.read(0, states.size()), find_start(outcome, b), u);
  return u;
}

double find_largest_distance(const Outcome& one, const Outcome& other, int b) {
  const MatrixX d = find_displacement(one, b) - find_displacement(other, b);
  double largest = 0.0;
  for (Eigen::Index j = 0; j < d.cols(); ++j) {
    const Eigen::Map<const Matrix3X> nodes(d.col(j).data(), 3, d.rows() / 3);
    largest = std::max(largest, nodes.colwise().norm().maxCoeff());
  }
  return largest;
}

}  // namespace limber::bench::trade
