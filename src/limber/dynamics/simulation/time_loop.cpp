// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/simulation/time_loop.hpp"

#include <fmt/format.h>

#include <utility>

#include "limber/common/errors.hpp"
#include "limber/dynamics/equations/motion_fields.hpp"
#include "limber/dynamics/newton/constraint_wrenches.hpp"
#include "limber/dynamics/simulation/interrupted.hpp"

namespace limber::dynamics {
namespace {

// Refreshes are at most this number of steps apart, which an interrupted run
// repeats; fewer of large systems, but not so few that new factors would add
// more than a few percent. A step and a solve each take about 1 us an unknown.
constexpr long kMostSteps = 256;
constexpr long kFewestSteps = 32;
constexpr double kMostWork = 4e6;  // steps and solves, times unknowns

}  // namespace

TimeLoop::TimeLoop(const SystemModel& model, const SimulationSettings& settings,
                   const SystemState& state, SimulationStatistics& statistics,
                   double refinement, const Followed& followed, Check check)
    : model_(model),
      statistics_(statistics),
      stepper_(model, settings, statistics.events, refinement),
      observers_(model, settings, state, followed, std::move(check), stepper_,
                 statistics),
      breakpoints_(model, settings, state.t),
      steps_(model, settings, state.t, refinement, stepper_, observers_,
             statistics),
      sampling_(model, state.t),
      pulse_(settings, state.t) {}

void TimeLoop::run(SystemState& state, const Visit& visit,
                   const Progress& progress, const CheckpointKeeper& keeper) {
  observers_.report_to(visit);
  pulse_.report_to(progress);
  keeper_ = keeper;
  try {
    if (!has_started_) {
      hold_checkpoint(state);
      begin(state);
      observers_.visit_start(state);
    }
    while (!breakpoints_.is_empty()) take_step(state);
  } catch (const Interrupted&) {
    keep_checkpoint();
    throw;
  }
}

bool TimeLoop::run_to(double t, SystemState& state,
                      const std::function<bool()>& stops) {
  if (!has_started_) begin(state);
  breakpoints_.stop_at(t);
  try {
    while (breakpoints_.has_until(t) && !stops()) take_step(state);
  } catch (...) {
    breakpoints_.stop_at(kNever);
    throw;
  }
  const bool is_there = !breakpoints_.has_until(t);
  breakpoints_.stop_at(kNever);
  return is_there;
}

// Samples at the start, before the first step.
void TimeLoop::begin(SystemState& state) {
  set_constraint_wrenches(model_, state);
  observers_.check(state, 0.0);
  sampling_.skip_until(state);
  if (take_samples(state)) set_constraint_wrenches(model_, state);
}

void TimeLoop::take_step(SystemState& state) {
  if (steps_.mark() != breakpoints_.next().time) enter_breakpoint(state);
  const Losses before = stepper_.losses();
  steps_.take(state, pulse_);
  // An output there contains the new inputs.
  if (steps_.has_arrived() && breakpoints_.next().is_sample) {
    at_jump_ = take_samples(state);
  }
  observers_.visit_within(state, before);
  observers_.check(state, steps_.length());
  if (steps_.has_arrived()) leave_breakpoint(state);
  if (is_refresh_due()) {
    refresh();
    hold_checkpoint(state);
    const std::chrono::duration<double> since = Clock::now() - kept_;
    if (since.count() >= keeper_.interval) keep_checkpoint();
  }
  if (!breakpoints_.is_empty()) pulse_.beat(state.t);
}

// Plans the steps to the next breakpoint.
void TimeLoop::enter_breakpoint(SystemState& state) {
  try {
    steps_.plan(state, breakpoints_.next().time, !has_started_);
    const double h = steps_.length();
    if (!has_started_) {
      const auto impulse = stepper_.start(state, h);
      if (impulse) {
        statistics_.warnings.push_back(describe(*impulse, state.t, h));
      }
      observers_.start(state, h, impulse ? impulse->dissipated : 0.0);
    }
    if (at_jump_) {
      stepper_.cross_jump(state, h);
      observers_.leave_jump(state);
      at_jump_ = false;
    }
  } catch (const NumericalError& error) {
    steps_.fail(state, steps_.length(),
                fmt::format("before the step at t = {:.9g} s: {}", state.t,
                            error.what()));
  }
  has_started_ = true;
}

void TimeLoop::leave_breakpoint(SystemState& state) {
  const Breakpoint& here = breakpoints_.next();
  at_jump_ |= here.is_jump;
  if (here.is_output) observers_.visit(state);
  // Peaks and outputs of the next step need what holds joints at its begin.
  if (here.is_jump || (at_jump_ && steps_.is_adaptive())) {
    set_constraint_wrenches(model_, state);
  }
  if (at_jump_) observers_.cross_jump(state);
  breakpoints_.pass();
}

// @returns whether inputs jump
bool TimeLoop::take_samples(SystemState& state) {
  const bool has_jump = sampling_.take(state);
  stepper_.add_between_steps(sampling_.flows());
  observers_.include_samples(state, steps_.length());
  return has_jump;
}

// Inputs jump where the last breakpoint's samples left them, or not at all.
void TimeLoop::repeat_external_samples(SystemState& state) {
  if (!sampling_.repeat_external(state)) return;
  const bool has_jump = take_samples(state);
  if (!has_started_) return;
  const bool had_jump = at_jump_;
  at_jump_ = has_jump || breakpoints_.last().is_jump;
  if (at_jump_ && !had_jump) observers_.cross_jump(state);
}

bool TimeLoop::is_refresh_due() const {
  const long steps = statistics_.steps - refreshed_steps_;
  if (steps >= kMostSteps) return true;
  const long solves = statistics_.linear_solves - refreshed_solves_;
  const auto unknowns =
      static_cast<double>(6 * std::ssize(model_.bodies) + model_.modal_count) +
      static_cast<double>(model_.nodal_count);
  return steps >= kFewestSteps &&
         static_cast<double>(solves + steps) * unknowns > kMostWork;
}

void TimeLoop::refresh() {
  stepper_.refresh();
  refreshed_steps_ = statistics_.steps;
  refreshed_solves_ = statistics_.linear_solves;
}

void TimeLoop::save(Archive& archive, SystemState& state) {
  refresh();
  exchange_memory(archive, state);
}

void TimeLoop::hold_checkpoint(SystemState& state) {
  if (!keeper_.keep) return;
  // It has about the size of the last one.
  Archive archive = Archive::write_into(
      checkpoint_ ? std::move(checkpoint_->numbers) : std::vector<double>());
  if (keeper_.exchange_outer) keeper_.exchange_outer(archive);
  if (has_started_) exchange_memory(archive, state);
  checkpoint_ = {state.t, archive.take_numbers(), {}, observers_.visits()};
}

void TimeLoop::keep_checkpoint() {
  if (!checkpoint_) return;
  checkpoint_->log = observers_.take_log();
  keeper_.keep(*checkpoint_);
  checkpoint_.reset();
  kept_ = Clock::now();
}

void TimeLoop::resume(Archive& archive, const std::vector<double>& log,
                      SystemState& state) {
  if (!archive.has_more()) return;  // of the start
  exchange_memory(archive, state);
  observers_.resume(state, log);
}

void TimeLoop::exchange_memory(Archive& archive, SystemState& state) {
  archive(state, has_started_, at_jump_, refreshed_steps_, refreshed_solves_);
  breakpoints_.exchange_memory(archive);
  steps_.exchange_memory(archive);
  stepper_.exchange_memory(archive, state);
  observers_.exchange_memory(archive);
  exchange_costs(archive, statistics_);
  archive(statistics_.events, statistics_.warnings);
}

}  // namespace limber::dynamics
