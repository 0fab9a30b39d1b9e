// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/simulation/simulator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "limber/common/errors.hpp"
#include "limber/common/records/archive.hpp"
#include "limber/dynamics/control/external_law.hpp"
#include "limber/dynamics/equations/energy.hpp"
#include "limber/dynamics/monitors/energy_verdict.hpp"
#include "limber/dynamics/monitors/linear_limit.hpp"
#include "limber/dynamics/monitors/rounding_limit.hpp"
#include "limber/dynamics/newton/constraint_wrenches.hpp"
#include "limber/dynamics/simulation/explicit_limit.hpp"
#include "limber/dynamics/simulation/settings_check.hpp"
#include "limber/dynamics/simulation/single_run.hpp"
#include "limber/dynamics/simulation/start_warnings.hpp"
#include "limber/dynamics/simulation/time_loop.hpp"
#include "limber/dynamics/terms/mean_frame.hpp"

namespace limber::dynamics {
namespace {

SimulationSettings check(const SystemModel& model, const SystemState& state,
                         const SimulationSettings& settings,
                         SimulationStatistics& statistics) {
  check_settings(model, state, settings);
  add_start_warnings(model, state, statistics);
  SimulationSettings limited = limit_step(model, state, settings, statistics);
  add_period_warning(model, limited, state.t, statistics);
  return limited;
}

double choose_refinement(const SimulationSettings& settings) {
  const bool is_one_pass =
      settings.tolerance > 0.0 && settings.passes == TolerancePasses::one;
  return is_one_pass ? kOnePassRefinement : 1.0;
}

}  // namespace

struct Simulator::Parts {
  Parts(const SystemModel& its_model, const SystemState& start,
        const SimulationSettings& requested)
      : model(its_model),
        state(start),
        settings(check(model, state, requested, statistics)),
        limit(model),
        loop(model, settings, state, statistics, choose_refinement(requested),
             {},
             [this](const SystemState& at) {
               limit.check(at, statistics.warnings);
             }),
        rounding(model) {
    set_constraint_wrenches(model, state);
    show();
    rounding.check(shown(), statistics.warnings);
  }

  [[nodiscard]] const SystemState& shown() const {
    return model.nodal_count == 0 ? state : framed;
  }

  // The caller's state: frames of unreduced bodies follow their nodes.
  void show() {
    if (model.nodal_count == 0) return;
    framed = state;
    update_mean_frames(model, framed);
  }

  // Warnings and checks at the end of a whole run.
  void judge() {
    RunRecord record;
    loop.store(record);
    warn_of_energy(settings.integrator, record.energy, statistics.warnings);
    check_energy(settings.integrator, record.energy);
  }

  const SystemModel& model;
  SystemState state;
  SystemState framed;
  SimulationStatistics statistics;
  SimulationSettings settings;
  LinearLimit limit;
  TimeLoop loop;
  RoundingLimit rounding;
};

Simulator::Simulator(const SystemModel& model, const SystemState& start,
                     const SimulationSettings& settings)
    : parts_(std::make_unique<Parts>(model, start, settings)) {}

Simulator::~Simulator() = default;

bool Simulator::advance_to(double t, const std::stop_token& stop) {
  return advance_to(t, [&stop] { return stop.stop_requested(); });
}

bool Simulator::advance_to(double t, const std::function<bool()>& stops) {
  const double now = parts_->state.t;
  const double end = parts_->settings.end_time;
  if (!(t >= now) || !(t <= end)) {
    throw InputError(
        fmt::format("advance_to: {:g} s; expected a time from {:g} s, that of "
                    "the state, to {:g} s, the settings' end",
                    t, now, end));
  }
  if (t == now) return true;
  bool is_there = false;
  try {
    is_there = parts_->loop.run_to(t, parts_->state, stops);
  } catch (const NumericalError&) {
    parts_->show();
    throw;
  }
  parts_->show();
  parts_->rounding.check(parts_->shown(), parts_->statistics.warnings);
  if (parts_->state.t == end) parts_->judge();
  return is_there;
}

void Simulator::set_external_outputs(std::span<const double> values) {
  std::vector<std::span<double>> outputs;
  std::size_t expected = 0;
  for (std::size_t i = 0; i < parts_->model.controllers.size(); ++i) {
    if (!is_external(parts_->model.controllers[i])) continue;
    outputs.emplace_back(parts_->state.controllers[i].memory);
    expected += outputs.back().size();
  }
  if (values.size() != expected) {
    throw InputError(
        fmt::format("{} outputs are set from outside; expected {}, one for "
                    "each number that controllers with external laws write",
                    values.size(), expected));
  }
  for (const std::span<double> output : outputs) {
    std::copy_n(values.begin(), output.size(), output.begin());
    values = values.subspan(output.size());
  }
  parts_->loop.repeat_external_samples(parts_->state);
  parts_->show();
}

const SystemState& Simulator::state() const { return parts_->shown(); }

EnergyBalance Simulator::calc_energy() const {
  EnergyBalance balance = dynamics::calc_energy(parts_->model, state());
  const Losses losses = parts_->loop.losses();
  balance.work = losses.work;
  balance.dissipated = losses.dissipated;
  return balance;
}

const SimulationStatistics& Simulator::statistics() const {
  return parts_->statistics;
}

Checkpoint Simulator::save() {
  refuse_hidden_memory(parts_->model,
                       "a run must continue identically from a checkpoint");
  Archive archive;
  parts_->limit.exchange_memory(archive);
  parts_->loop.save(archive, parts_->state);
  return {parts_->state.t, archive.take_numbers()};
}

void Simulator::restore(const Checkpoint& checkpoint) {
  refuse_hidden_memory(parts_->model,
                       "a run must continue identically from a checkpoint");
  Archive archive(checkpoint.numbers);
  parts_->limit.exchange_memory(archive);
  parts_->loop.resume(archive, {}, parts_->state);
  parts_->show();
}

}  // namespace limber::dynamics
