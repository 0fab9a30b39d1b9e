// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/simulation/run_observers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "limber/common/errors.hpp"
#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/equations/pair_forces.hpp"
#include "limber/dynamics/simulation/failure_diagnosis.hpp"
#include "limber/dynamics/simulation/output_state.hpp"

namespace limber::dynamics {
namespace {

constexpr long kStepsBetweenLooks = 32;  // checks of the energy
constexpr double kWhole = 1.0 - 1e-9;    // of a step, that counts as all of it

// Step of the run, 0 with a tolerance [s].
double fixed_step(const SimulationSettings& settings) {
  return settings.tolerance > 0.0 ? 0.0 : settings.step;
}

}  // namespace

RunObservers::RunObservers(const SystemModel& model,
                           const SimulationSettings& settings,
                           const SystemState& start, const Followed& followed,
                           Check check, EventStepper& stepper,
                           SimulationStatistics& statistics)
    : model_(model),
      settings_(settings),
      stepper_(stepper),
      statistics_(statistics),
      check_(std::move(check)),
      saturation_(model),
      peaks_(model, followed,
             choose_envelope_edges(start.t, settings.output_times,
                                   settings.end_time)),
      step_observer_(model, settings.integrator, fixed_step(settings),
                     stepper.scratch()),
      contacts_(model, settings.integrator, fixed_step(settings)),
      sound_(start),
      beside_(start) {
  steps_.of_body.resize(model.bodies.size());
  steps_.of_pair.resize(model.pairs.size());
  const std::vector<double>& times = settings.output_times;
  const auto first = settings.tolerance > 0.0
                         ? std::upper_bound(times.begin(), times.end(), start.t)
                         : times.end();
  output_ = static_cast<std::size_t>(first - times.begin());
}

void RunObservers::start(const SystemState& state, double h, double lost) {
  SystemTerms& terms = stepper_.scratch();
  calc_terms(model_, state, Side::right, terms);
  clash_ = find_start_clash(model_, state, terms, h);
  peaks_.start(state);
  step_observer_.start(state, terms, lost, statistics_.events);
  contacts_.include(state, stepper_.touches(), step_observer_,
                    stepper_.flows());
}

StepCause RunObservers::include(const SystemState& state,
                                const PlannedStep& planned, double begin) {
  peaks_.include(state);
  step_observer_.include(state, stepper_.terms(), stepper_.flows(),
                         is_look_due(state, statistics_.steps + 1),
                         statistics_.events);
  contacts_.include(state, stepper_.touches(), step_observer_,
                    stepper_.flows());
  timer_.measured.monitors += timer_.lap();

  StepCause cause = planned.cause;
  const double length = state.t - begin;
  if (stepper_.length() < planned.length * kWhole) cause = StepCause::impact;
  if (length < stepper_.length() * kWhole) cause = StepCause::event;
  steps_.add(cause, length);
  if (cause == StepCause::impact && stepper_.impact_pair()) {
    steps_.of_pair.at(*stepper_.impact_pair()) += 1.0;
  }
  if (cause == StepCause::tolerance) {
    steps_.of_body[stepper_.last().error_body] += 1.0;
  }
  return cause;
}

bool RunObservers::is_look_due(const SystemState& state, long steps) const {
  return steps <= kStepsBetweenLooks || steps % kStepsBetweenLooks == 0 ||
         state.t == settings_.end_time;
}

void RunObservers::check(const SystemState& state, double h) {
  const bool has_started = h > 0.0;
  if (has_started && is_look_due(state, statistics_.steps)) inspect(state, h);
  if (!check_) return;
  try {
    check_(state);
  } catch (const NumericalError& error) {
    if (has_started) inspect(state, h);  // which may be the cause
    throw NumericalError(error.what() + find_driver(model_, state));
  }
}

void RunObservers::inspect(const SystemState& state, double h) {
  const auto excess =
      step_observer_.find_blow_up(state.t == settings_.end_time);
  if (!excess) {
    if (!step_observer_.has_too_much()) sound_ = state;
    return;
  }
  const bool is_early = statistics_.steps <= kStepsBetweenLooks;
  const IntegratorTraits& traits = traits_of(settings_.integrator);
  const char* advice = traits.is_implicit && traits.order == 1
                           ? "a smaller step may help"
                           : "a smaller step or implicit-euler may help";
  fail(state, h, h,
       fmt::format(
           "the motion blows up at t = {:.9g} s: {:.3g} J are stored, most in "
           "{}, but the start and the loads supplied only {:.3g} J; {}",
           state.t, excess->stored, find_most_energy(model_, state),
           excess->accounted, is_early && !clash_.empty() ? clash_ : advice));
}

// A state after a blow-up does not show its cause.
bool RunObservers::is_sound(const SystemState& state) {
  try {
    return !step_observer_.has_too_much(state);
  } catch (const NumericalError&) {
    return true;  // for example a reversed joint axis, which is a cause
  }
}

void RunObservers::fail(const SystemState& state, double failed, double h,
                        const std::string& what) {
  const bool is_cause_here = is_sound(state);
  const SystemState& at = is_cause_here ? state : sound_;
  const auto cause =
      find_cause(model_, at, settings_.integrator, is_cause_here ? failed : h);
  throw NumericalError((cause.empty() ? what : what + "; " + cause) +
                       find_driver(model_, at));
}

void RunObservers::visit_start(const SystemState& state) {
  const std::vector<double>& times = settings_.output_times;
  if (!times.empty() && times.front() <= state.t) visit(state);
}

void RunObservers::visit(const SystemState& state, const Losses& losses) {
  const StepTimer::Clock::time_point begin = StepTimer::Clock::now();
  if (visit_) visit_(state, losses);
  ++visits_;
  timer_.add_output(begin);
}

void RunObservers::visit_within(const SystemState& state,
                                const Losses& before) {
  const SystemState& begin = stepper_.before();
  const StepResult& step = stepper_.last();
  const double h = state.t - begin.t;
  const std::vector<double>& times = settings_.output_times;
  for (; output_ < times.size() && times[output_] <= state.t; ++output_) {
    const double t = times[output_];
    if (t == state.t) {
      visit(state);
      continue;
    }
    const double s = (t - begin.t) / h;
    find_output_state(model_, begin, state, s, beside_);
    beside_.t = t;
    // Powers are assumed linear over a step.
    const double rise = 0.5 * s * s * h;
    visit(beside_, {before.work + s * h * step.begin.loads +
                        rise * (step.end.loads - step.begin.loads),
                    before.dissipated + s * h * step.begin.dissipated +
                        rise * (step.end.dissipated - step.begin.dissipated)});
  }
}

// The forces of pairs are evaluated at every solve and once before, and kept
// for all who ask at the same state: here they are at one that nobody has asked
// for.
void RunObservers::separate_contact(const SystemState& state, long solves) {
  constexpr double kAside = 1e-12;  // [m]
  if (!timer_.is_active() || model_.pairs.empty()) return;
  beside_ = state;
  double aside = 0.0;
  for (BodyState& body : beside_.bodies) {
    aside += kAside;
    body.p_WB.array() += aside;
  }
  try {
    SystemTerms& terms = stepper_.scratch();
    calc_terms(model_, state, Side::right, terms);
    static_cast<void>(timer_.lap());
    apply_pairs(model_, beside_, now_of(beside_), terms);
  } catch (const NumericalError&) {  // the next step reports it
    return;
  }
  const double moved =
      std::min((static_cast<double>(solves) + 1.0) * timer_.lap(),
               timer_.measured.newton);
  timer_.measured.newton -= moved;
  timer_.measured.contact += moved;
}

void RunObservers::store(RunRecord& record) {
  peaks_.store(record.peaks, record.places, record.envelopes);
  record.energy = step_observer_.find_energy();
  record.contacts = contacts_.find_records();
  record.steps = steps_;
  record.times = timer_.find_times();
  step_observer_.add_warnings(statistics_.warnings);
  contacts_.add_warnings(statistics_.warnings);
  stepper_.add_warnings(statistics_.warnings);
}

void RunObservers::exchange_memory(Archive& archive) {
  archive(clash_, output_, visits_);
  steps_.exchange_memory(archive);
  peaks_.exchange_memory(archive);
  step_observer_.exchange_memory(archive);
  contacts_.exchange_memory(archive);
  saturation_.exchange_memory(archive);
}

void RunObservers::resume(const SystemState& state,
                          const std::vector<double>& log) {
  peaks_.restore_log(log);
  sound_ = state;
}

}  // namespace limber::dynamics
