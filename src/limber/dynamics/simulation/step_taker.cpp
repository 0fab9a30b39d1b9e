// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/simulation/step_taker.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "limber/common/errors.hpp"
#include "limber/dynamics/simulation/breakpoints.hpp"
#include "limber/dynamics/simulation/failure_diagnosis.hpp"

namespace limber::dynamics {
namespace {

constexpr int kMostHalvings = 10;
constexpr double kSameTime =
    1e-9;  // fraction of a step that counts as its end [-]
// Errors of an oscillation's steps add up to twice their sum, or a little more.
constexpr double kBudgetFraction = 0.5;  // of the tolerance

ErrorBudget make_budget(const SimulationSettings& settings, double start) {
  if (settings.passes != TolerancePasses::verified) {
    return ErrorBudget::in_all(kBudgetFraction * settings.tolerance,
                               settings.end_time - start);
  }
  return ErrorBudget::each(settings.tolerance);
}

}  // namespace

StepTaker::StepTaker(const SystemModel& model,
                     const SimulationSettings& settings, double start,
                     double refinement, EventStepper& stepper,
                     RunObservers& observers, SimulationStatistics& statistics)
    : model_(model),
      settings_(settings),
      start_(start),
      stepper_(stepper),
      observers_(observers),
      statistics_(statistics),
      control_(make_budget(settings, start), settings.step, refinement,
               find_oscillations(model)),
      budget_(model.bodies.size()) {}

void StepTaker::plan(const SystemState& state, double mark, bool is_first) {
  origin_ = state.t;
  mark_ = mark;
  part_ = 0;
  parts_ = count_equal_steps(settings_, origin_, mark_);
  if (is_adaptive() && is_first) {
    control_.begin(find_first_step(model_, state, control_.allowed()));
  }
  h_ = is_adaptive() ? plan_free(state).length
                     : (mark_ - origin_) / static_cast<double>(parts_);
}

void StepTaker::take(SystemState& state, ProgressPulse& pulse) {
  // Not the first step, in which monitors do work that is done once.
  observers_.timer().begin(statistics_.steps - 1);
  const long solves = statistics_.linear_solves;
  is_adaptive() ? take_free(state, pulse) : take_equal(state, pulse);
  observers_.separate_contact(state, statistics_.linear_solves - solves);
  ++statistics_.steps;
}

void StepTaker::take_equal(SystemState& state, ProgressPulse& pulse) {
  // Times are computed from the origin, not as a sum of steps.
  const double end = part_ + 1 == parts_
                         ? mark_
                         : origin_ + static_cast<double>(part_ + 1) * h_;
  PlannedStep part;  // of a rest, the cause is that of what cut it off
  bool is_whole = true;
  while (end - state.t > kSameTime * h_) {
    const double left = is_whole ? h_ : end - state.t;
    part.length = std::min(left, std::ldexp(h_, -depth_));
    const bool is_last = part.length >= left * (1.0 - kSameTime);
    if (is_last) part.length = left;
    if (attempt(state, part, is_last ? end : state.t + part.length)) {
      is_whole = false;
      // Parts of impacts have limits of their own.
      const bool is_cut = stepper_.length() < part.length;
      if (!is_last && !is_cut) count_fraction(state);
    }
    if (end - state.t > kSameTime * h_) pulse.beat_within_step(state.t);
  }
  state.t = end;
  if (depth_ > 0) --depth_;
  ++part_;
}

void StepTaker::take_free(SystemState& state, ProgressPulse& pulse) {
  while (!attempt_free(state)) pulse.beat_within_step(state.t);
  if (mark_ - state.t > kSameTime * h_) return;
  state.t = mark_;
  part_ = parts_;
}

// @returns whether it is accepted
bool StepTaker::attempt_free(SystemState& state) {
  check_most_steps(state);
  PlannedStep step = plan_free(state);
  const double left = mark_ - state.t;
  const double least = find_same_time(state.t, start_);
  if (left - step.length < std::max(kSameTime * step.length, least)) {
    step.length = left;
  }
  h_ = step.length;
  if (!(h_ > least)) {
    fail(state, h_,
         fmt::format("body '{}' at t = {:.9g} s: the error of {:.3g} m that a "
                     "step may have requires steps below {:.3g} s",
                     model_.bodies[stepper_.last().error_body].name, state.t,
                     control_.allowed(), h_));
  }
  return attempt(state, step, h_ == left ? mark_ : state.t + h_);
}

// Attempts a step, or a part of one, to a time. If it fails, those that follow
// are halved.
// @param step gets the cause of the length that it had
// @returns whether it was taken
bool StepTaker::attempt(SystemState& state, PlannedStep& step, double end) {
  check_budget(state, step.length);
  StepTimer& timer = observers_.timer();
  const double begin = state.t;
  bool is_good = true;
  try {
    stepper_.attempt(state, step.length, end);
    timer.measured.newton += timer.lap();
    is_good = !is_adaptive() ||
              control_.accepts(stepper_.length(), stepper_.last().error);
    is_good ? stepper_.settle(state, h_) : stepper_.take_back(state);
    timer.measured.contact += timer.lap();
  } catch (const NumericalError& error) {
    failure_ = error.what();
    statistics_.linear_solves += stepper_.take_solves();
    halve(state, step.length);
    return false;
  }
  statistics_.linear_solves += stepper_.take_solves();
  statistics_.newton_iterations += stepper_.last().iterations;
  statistics_.factorizations += stepper_.last().factorizations;
  if (is_adaptive()) depth_ = 0;
  if (!is_good) {
    ++statistics_.rejected_steps;
    return false;
  }
  if (depth_ > 0) step.cause = StepCause::failure;
  step.cause = observers_.include(state, step, begin);
  return true;
}

void StepTaker::halve(const SystemState& state, double h) {
  control_.halve();
  ++statistics_.halved_steps;
  if (++depth_ <= kMostHalvings) return;
  fail(state, h,
       fmt::format("{}; at t = {:.9g} s a step of {:.3g} s, halved {} times, "
                   "did not help",
                   failure_, state.t, h, kMostHalvings));
}

void StepTaker::check_budget(const SystemState& state, double h) {
  const long steps = statistics_.steps + statistics_.rejected_steps;
  if (budget_.allows_solves(statistics_.linear_solves, steps)) return;
  fail(
      state, h,
      fmt::format("at t = {:.9g} s: {} steps needed {} linear solves, where 2 "
                  "or 3 each are usual, and {} halvings; use shorter steps; {}",
                  state.t, steps, statistics_.linear_solves,
                  statistics_.halved_steps, describe_failure(state)));
}

void StepTaker::check_most_steps(const SystemState& state) {
  const long steps = statistics_.steps + statistics_.rejected_steps;
  if (steps < settings_.most_steps) return;
  const std::string why = control_.describe_oscillation(state.t, mark_, h_);
  fail(state, h_,
       fmt::format("at t = {:.9g} s: the tolerance of {:.3g} m takes more "
                   "steps than most_steps allows, now {:.3g} s long; use a "
                   "larger tolerance, a shorter time or more steps; {}",
                   state.t, settings_.tolerance, h_,
                   why.empty() ? describe_failure(state) : why));
}

// Without a budget, repeated halving could make a run a thousand times longer.
void StepTaker::count_fraction(const SystemState& state) {
  if (budget_.allows_fractions(++fractions_, statistics_.steps)) return;
  fail(state, std::ldexp(h_, -depth_),
       fmt::format(
           "at t = {:.9g} s: steps of {:.3g} s succeed only after repeated "
           "halving, {} times so far; use shorter steps or a tolerance; {}",
           state.t, h_, statistics_.halved_steps, describe_failure(state)));
}

void StepTaker::fail(const SystemState& state, double h,
                     const std::string& what) {
  observers_.fail(state, h, h_, what);
}

// Why steps failed: the last failure, or the location of the energy.
std::string StepTaker::describe_failure(const SystemState& state) const {
  if (!failure_.empty()) return "the last that failed: " + failure_;
  return "most energy is in " + find_most_energy(model_, state);
}

PlannedStep StepTaker::plan_free(const SystemState& state) {
  return control_.plan(state, origin_, mark_,
                       stepper_.touches().find_longest_step(state.t));
}

void StepTaker::exchange_memory(Archive& archive) {
  archive(origin_, mark_, part_, parts_, h_, depth_, fractions_, failure_);
  control_.exchange_memory(archive);
}

}  // namespace limber::dynamics
