// SPDX-License-Identifier: BSD-3-Clause
// Each step of the time loop: planned or as long as the tolerance allows,
// halved where it fails.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "limber/common/errors.hpp"
#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/equations/pair_forces.hpp"
#include "limber/dynamics/simulation/failure_diagnosis.hpp"
#include "limber/dynamics/simulation/time_loop.hpp"

namespace limber::dynamics {
namespace {

constexpr int kMostHalvings = 10;
constexpr double kSameTime =
    1e-9;  // fraction of a step that counts as its end [-]
constexpr double kFewestStepsToAMark = 4.0;  // with a tolerance
// With a tolerance: the mean force in a step is then right to 1.3 % of the
// amplitude, and the estimate of a step's error sees the force change.
constexpr double kFewestStepsToAPeriod = 16.0;

}  // namespace

void TimeLoop::halve(const SystemState& state, double h,
                     const std::string& why) {
  ++statistics_.halved_steps;
  if (++depth_ <= kMostHalvings) return;
  fail(state, h,
       fmt::format("{}; at t = {:.9g} s a step of {:.3g} s, halved {} times, "
                   "did not help",
                   why, state.t, h, kMostHalvings));
}

// Why steps failed: the last failure, or the location of the energy.
std::string TimeLoop::describe_failure(const SystemState& state) const {
  if (!failure_.empty()) return "the last that failed: " + failure_;
  return "most energy is in " + find_most_energy(model_, state);
}

void TimeLoop::check_budget(const SystemState& state, double h) {
  const long steps = statistics_.steps + statistics_.rejected_steps;
  if (budget_.allows_solves(statistics_.linear_solves, steps)) return;
  fail(
      state, h,
      fmt::format("at t = {:.9g} s: {} steps needed {} linear solves, where 2 "
                  "or 3 each are usual, and {} halvings; use shorter steps; {}",
                  state.t, steps, statistics_.linear_solves,
                  statistics_.halved_steps, describe_failure(state)));
}

// Performs a step; if it fails, steps are halved.
template <typename Work>
bool TimeLoop::goes_through(const SystemState& state, double h,
                            const Work& work) {
  check_budget(state, h);
  bool fails = false;
  try {
    work();
  } catch (const NumericalError& error) {
    fails = true;
    failure_ = error.what();
  }
  statistics_.linear_solves += stepper_.take_solves();
  if (fails) halve(state, h, failure_);
  return !fails;
}

// Without a budget, repeated halving could make a run a thousand times longer.
void TimeLoop::count_fraction(const SystemState& state) {
  if (budget_.allows_fractions(++fractions_, statistics_.steps)) return;
  fail(state, std::ldexp(h_, -depth_),
       fmt::format(
           "at t = {:.9g} s: steps of {:.3g} s succeed only after repeated "
           "halving, {} times so far; use shorter steps or a tolerance; {}",
           state.t, h_, statistics_.halved_steps, describe_failure(state)));
}

void TimeLoop::take_samples(SystemState& state) {
  jumps_.clear();
  inputs_jump_ |= sampling_.take(state, jumps_.supplied);
  saturation_.include(state, h_, statistics_.warnings);
  stepper_.add_between_steps(jumps_);
}

// Inputs jump where the last breakpoint's samples left them, or not at all.
void TimeLoop::repeat_external_samples(SystemState& state) {
  if (!sampling_.repeat_external(state)) return;
  jumps_.clear();
  const bool has_jump = sampling_.take(state, jumps_.supplied);
  stepper_.add_between_steps(jumps_);
  if (!has_started_) return;
  const bool had_jump = at_jump_;
  at_jump_ = has_jump || breakpoints_[next_ - 1].is_jump;
  if (at_jump_ && !had_jump) peaks_.cross_jump(state);
}

// One of equal steps, in parts if it is cut by events or halved.
void TimeLoop::take_planned_step(SystemState& state, const Progress& progress) {
  // Times are computed from the breakpoint, not as a sum of steps.
  const double end = part_ + 1 == parts_
                         ? breakpoints_[next_].time
                         : origin_ + static_cast<double>(part_ + 1) * h_;
  const StepResult before = stepper_.totals();
  const long solves = statistics_.linear_solves;
  // Not the first step, in which monitors do work that is done once.
  timer_.begin(statistics_.steps - 1);
  bool is_whole = true;
  StepCause cause = StepCause::given;  // of a rest, that of what cut it off
  while (end - state.t > kSameTime * h_) {
    const double left = is_whole ? h_ : end - state.t;
    const double h = std::min(left, std::ldexp(h_, -depth_));
    const bool is_last = h >= left * (1.0 - kSameTime);
    const std::size_t events = statistics_.events.size();
    const double begin = state.t;
    const bool has_moved = goes_through(state, h, [&] {
      stepper_.attempt(state, is_last ? left : h, is_last ? end : state.t + h);
      timer_.measured.newton += timer_.lap();
      stepper_.settle(state, h_);
      timer_.measured.contact += timer_.lap();
    });
    is_whole = is_whole && !has_moved;
    if (has_moved) {
      watch_step(state, events);
      timer_.measured.monitors += timer_.lap();
      if (depth_ > 0) cause = StepCause::failure;
      cause = record_step({h, cause}, state.t - begin);
    }
    // Parts of impacts have limits of their own.
    const bool is_fraction = !is_last && !(stepper_.length() < h);
    if (has_moved && is_fraction) count_fraction(state);
    if (end - state.t > kSameTime * h_) check_stop_within_step(state, progress);
  }
  state.t = end;
  time_contact(state, statistics_.linear_solves - solves);
  if (depth_ > 0) --depth_;
  count_step(before);
  if (part_ + 1 == parts_ && breakpoints_[next_].is_sample) take_samples(state);
  ++part_;
}

// The fastest one from t to the next breakpoint.
const Oscillation* TimeLoop::find_oscillation(double t) const {
  return find_fastest(oscillations_, 0.5 * (t + breakpoints_[next_].time));
}

// The longest step that shows what does not appear in its error: loads that are
// zero at both ends, or the same after a whole period, and touches.
TimeLoop::PlannedStep TimeLoop::limit_free_step(const SystemState& state) {
  const double span = breakpoints_[next_].time - origin_;
  const Oscillation* fastest = find_oscillation(state.t);
  const double period = fastest ? fastest->period : kNever;
  PlannedStep step{span / kFewestStepsToAMark, StepCause::breakpoint};
  const auto limit = [&](double length, StepCause cause) {
    if (length < step.length) step = {length, cause};
  };
  limit(period / kFewestStepsToAPeriod, StepCause::oscillation);
  limit(stepper_.touches().find_longest_step(state.t), StepCause::impact);
  step.length *= refinement_;
  return step;
}

// @param left until the next breakpoint [s]
TimeLoop::PlannedStep TimeLoop::plan_free_step(const SystemState& state,
                                               double left) {
  const double proposed = control_.propose(state, left);
  const PlannedStep limit = limit_free_step(state);
  if (limit.length < proposed) return limit;
  if (proposed >= left) return {proposed, StepCause::breakpoint};
  if (proposed < control_.step()) return {proposed, StepCause::rotation};
  const bool is_longest = proposed >= refinement_ * settings_.step;
  return {proposed, is_longest ? StepCause::given : StepCause::tolerance};
}

// Records a step from what was planned and how long it became [s].
// @returns what determined that
StepCause TimeLoop::record_step(const PlannedStep& planned, double length) {
  StepCause cause = planned.cause;
  if (stepper_.length() < planned.length * (1.0 - kSameTime)) {
    cause = StepCause::impact;
  }
  if (length < stepper_.length() * (1.0 - kSameTime)) cause = StepCause::event;
  steps_.add(cause, length);
  if (cause == StepCause::impact && !steps_.of_pair.empty()) {
    steps_.of_pair[stepper_.impact_pair()] += 1.0;
  }
  if (cause == StepCause::tolerance) {
    steps_.of_body[stepper_.last().error_body] += 1.0;
  }
  return cause;
}

// The part of a measured step that the forces of pairs took: they are evaluated
// at every solve and once before, and kept for all who ask at the same state.
// Measured where nobody has asked.
void TimeLoop::time_contact(const SystemState& state, long solves) {
  constexpr double kAside = 1e-12;  // [m]
  if (!timer_.is_active() || model_.pairs.empty()) return;
  within_ = state;
  double aside = 0.0;
  for (BodyState& body : within_.bodies) {
    aside += kAside;
    body.p_WB.array() += aside;
  }
  try {
    calc_terms(model_, state, Side::right, terms_);
    static_cast<void>(timer_.lap());
    apply_pairs(model_, within_, now_of(within_), terms_);
  } catch (const NumericalError&) {  // the next step reports it
    return;
  }
  const double moved =
      std::min((static_cast<double>(solves) + 1.0) * timer_.lap(),
               timer_.measured.newton);
  timer_.measured.newton -= moved;
  timer_.measured.contact += moved;
}

// Why steps to a tolerance are short.
std::string TimeLoop::describe_short_steps(const SystemState& state) const {
  const Oscillation* fastest = find_oscillation(state.t);
  if (!fastest ||
      h_ < 0.5 * refinement_ * fastest->period / kFewestStepsToAPeriod) {
    return describe_failure(state);
  }
  return fmt::format("{} has a period of {:.3g} s, which they follow",
                     fastest->name, fastest->period);
}

// A step as long as the tolerance allows. @returns whether it is accepted
bool TimeLoop::take_free_step(SystemState& state, const Visit& visit) {
  if (statistics_.steps + statistics_.rejected_steps >= settings_.most_steps) {
    fail(state, h_,
         fmt::format("at t = {:.9g} s: the tolerance of {:.3g} m takes more "
                     "steps than most_steps allows, now {:.3g} s long; use a "
                     "larger tolerance, a shorter time or more steps; {}",
                     state.t, settings_.tolerance, h_,
                     describe_short_steps(state)));
  }
  const double mark = breakpoints_[next_].time;
  const StepResult before = stepper_.totals();
  const Losses losses_before = losses();
  const double left = mark - state.t;
  PlannedStep planned = plan_free_step(state, left);
  h_ = planned.length;
  const double least = find_same_time(state.t, start_);
  if (left - h_ < std::max(kSameTime * h_, least)) h_ = left;
  planned.length = h_;
  if (!(h_ > least)) {
    fail(state, h_,
         fmt::format("body '{}' at t = {:.9g} s: the error of {:.3g} m that a "
                     "step may have requires steps below {:.3g} s",
                     model_.bodies[stepper_.last().error_body].name, state.t,
                     control_.allowed(), h_));
  }
  bool counts = false;
  const std::size_t events = statistics_.events.size();
  const double begin = state.t;
  const long solves = statistics_.linear_solves;
  // Not the first step, in which monitors do work that is done once.
  timer_.begin(statistics_.steps - 1);
  const bool has_moved = goes_through(state, h_, [&] {
    stepper_.attempt(state, h_, h_ == left ? mark : state.t + h_);
    timer_.measured.newton += timer_.lap();
    counts = control_.accepts(stepper_.length(), stepper_.last().error);
    counts ? stepper_.settle(state, h_) : stepper_.take_back(state);
    timer_.measured.contact += timer_.lap();
  });
  if (!has_moved) {
    control_.halve();
    return false;
  }
  depth_ = 0;
  if (!counts) {
    ++statistics_.rejected_steps;
    statistics_.newton_iterations += stepper_.last().iterations;
    statistics_.factorizations += stepper_.last().factorizations;
    return false;
  }
  count_step(before);
  watch_step(state, events);
  timer_.measured.monitors += timer_.lap();
  record_step(planned, state.t - begin);
  time_contact(state, statistics_.linear_solves - solves);
  // An output there contains the new inputs.
  if (breakpoints_[next_].is_sample && mark - state.t <= kSameTime * h_) {
    state.t = mark;
    take_samples(state);
  }
  visit_within(stepper_.before(), state, losses_before, visit);
  if (mark - state.t <= kSameTime * h_) {
    state.t = mark;
    part_ = parts_;
  }
  return true;
}

}  // namespace limber::dynamics
