// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/simulation/time_loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "limber/common/errors.hpp"
#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/equations/motion_fields.hpp"
#include "limber/dynamics/simulation/failure_diagnosis.hpp"
#include "limber/dynamics/simulation/interrupted.hpp"
#include "limber/dynamics/system/interpolation.hpp"

namespace limber::dynamics {
namespace {

// Number of steps of at most `longest`, except for the rounding of times.
long count_parts(double from, double to, double longest) {
  constexpr double kRounding = 4.0 * std::numeric_limits<double>::epsilon();
  const double span =
      to - from - kRounding * std::max(std::abs(from), std::abs(to));
  return std::max(static_cast<long>(std::ceil(span / longest * (1.0 - 1e-12))),
                  1L);
}

constexpr long kStepsBetweenLooks = 32;  // checks of the energy
// Refreshes are at most this number of steps apart, which an interrupted run
// repeats; fewer of large systems, but not so few that new factors would add
// more than a few percent. A step and a solve each take about 1 us an unknown.
constexpr long kMostSteps = 256;
constexpr long kFewestSteps = 32;
constexpr double kMostWork = 4e6;  // steps and solves, times unknowns

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

TimeLoop::TimeLoop(const SystemModel& model, const SimulationSettings& settings,
                   const SystemState& state, SimulationStatistics& statistics,
                   double refinement, const Followed& followed, Check check)
    : model_(model),
      settings_(settings),
      statistics_(statistics),
      start_(state.t),
      starts_with_output_(!settings.output_times.empty() &&
                          settings.output_times.front() <= state.t),
      breakpoints_(find_step_breakpoints(model, state.t, settings)),
      outputs_(find_outputs_after(state.t, settings)),
      refinement_(refinement),
      oscillations_(find_oscillations(model)),
      stepper_(model, settings, statistics.events, refinement),
      sampling_(model, state.t),
      saturation_(model),
      control_(make_budget(settings, state.t), settings.step, refinement),
      peaks_(model, followed,
             choose_envelope_edges(state.t, settings.output_times,
                                   settings.end_time)),
      step_observer_(model, settings.integrator,
                     settings.tolerance > 0.0 ? 0.0 : settings.step),
      contacts_(model, settings.integrator,
                settings.tolerance > 0.0 ? 0.0 : settings.step),
      check_(std::move(check)),
      budget_(model.bodies.size()),
      terms_(make_terms(model)),
      jumps_(make_flows(model)),
      within_(state),
      sound_(state),
      kept_(Clock::now()) {
  steps_.of_body.resize(model.bodies.size());
  steps_.of_pair.resize(model.pairs.size());
}

Losses TimeLoop::losses() const {
  return {stepper_.totals().load_work, stepper_.totals().dissipated};
}

void TimeLoop::exchange_memory(Archive& archive, SystemState& state) {
  archive(state, has_started_, next_, part_, parts_, origin_, h_, at_jump_,
          depth_, fractions_, failure_, clash_, output_, visits_,
          refreshed_steps_, refreshed_solves_);
  stepper_.exchange_memory(archive, state);
  control_.exchange_memory(archive);
  steps_.exchange_memory(archive);
  peaks_.exchange_memory(archive);
  step_observer_.exchange_memory(archive);
  contacts_.exchange_memory(archive);
  saturation_.exchange_memory(archive);
  exchange_costs(archive, statistics_);
  archive(statistics_.events, statistics_.warnings);
}

void TimeLoop::resume(const Checkpoint& checkpoint, SystemState& state) {
  if (checkpoint.numbers.empty()) return;  // of the start
  Archive archive(checkpoint.numbers);
  exchange_memory(archive, state);
  peaks_.restore_log(checkpoint.log);
  sound_ = state;
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

Checkpoint TimeLoop::save(SystemState& state) {
  refresh();
  Archive archive;
  exchange_memory(archive, state);
  return {state.t, archive.take_numbers(), {}, visits_};
}

void TimeLoop::hold_checkpoint(SystemState& state,
                               const CheckpointKeeper& keeper) {
  // It has about the size of the last one.
  Archive archive = Archive::write_into(
      checkpoint_ ? std::move(checkpoint_->numbers) : std::vector<double>());
  if (keeper.write_outer) keeper.write_outer(archive);
  if (has_started_) exchange_memory(archive, state);
  checkpoint_ = {state.t, archive.take_numbers(), {}, visits_};
}

void TimeLoop::keep_checkpoint(const CheckpointKeeper& keeper) {
  if (!checkpoint_) return;
  checkpoint_->log = peaks_.take_log();
  keeper.keep(*checkpoint_);
  checkpoint_.reset();
  kept_ = Clock::now();
}

// Fraction of the work that is done at a time; of the time, if the number of
// steps depends on a tolerance.
double TimeLoop::find_fraction(double t) const {
  const double end = settings_.end_time;
  if (settings_.tolerance > 0.0) return (t - start_) / (end - start_);
  return count_steps(settings_, start_, t) /
         count_steps(settings_, start_, end);
}

// A state after a blow-up does not show its cause.
bool TimeLoop::is_sound(const SystemState& state) {
  try {
    return !step_observer_.has_too_much(state);
  } catch (const NumericalError&) {
    return true;  // for example a reversed joint axis, which is a cause
  }
}

void TimeLoop::fail(const SystemState& state, double h,
                    const std::string& what) {
  const bool is_cause_here = is_sound(state);
  const auto cause = find_cause(model_, is_cause_here ? state : sound_,
                                settings_.integrator, is_cause_here ? h : h_);
  throw NumericalError((cause.empty() ? what : what + "; " + cause) +
                       find_driver(model_, is_cause_here ? state : sound_));
}

void TimeLoop::inspect(const SystemState& state) {
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
  fail(state, h_,
       fmt::format(
           "the motion blows up at t = {:.9g} s: {:.3g} J are stored, most in "
           "{}, but the start and the loads supplied only {:.3g} J; {}",
           state.t, excess->stored, find_most_energy(model_, state),
           excess->accounted, is_early && !clash_.empty() ? clash_ : advice));
}

// Energies that blow up are the cause of other failures.
void TimeLoop::check(const SystemState& state) {
  if (!check_) return;
  try {
    check_(state);
  } catch (const NumericalError& error) {
    if (has_started_) inspect(state);
    throw NumericalError(error.what() + find_driver(model_, state));
  }
}

void TimeLoop::count_step(const StepResult& since) {
  const StepResult& now = stepper_.totals();
  statistics_.newton_iterations += now.iterations - since.iterations;
  statistics_.factorizations += now.factorizations - since.factorizations;
}

bool TimeLoop::is_look_due(const SystemState& state, long steps) const {
  return steps <= kStepsBetweenLooks || steps % kStepsBetweenLooks == 0 ||
         state.t == settings_.end_time;
}

void TimeLoop::watch_step(const SystemState& state, std::size_t events_before) {
  peaks_.include(state);
  const SystemTerms* smooth =
      statistics_.events.size() == events_before ? &stepper_.terms() : nullptr;
  step_observer_.include(state, smooth, stepper_.flows(),
                         is_look_due(state, statistics_.steps + 1),
                         statistics_.events);
  contacts_.include(state, stepper_.touches(), step_observer_,
                    stepper_.flows());
}

void TimeLoop::store(RunRecord& record) {
  peaks_.store(record.peaks, record.places, record.envelopes);
  record.energy = step_observer_.find_energy();
  record.contacts = contacts_.find_records();
  record.steps = steps_;
  record.times = timer_.find_times();
  step_observer_.add_warnings(statistics_.warnings);
  contacts_.add_warnings(statistics_.warnings);
  if (const auto pair = stepper_.take_excess()) {
    statistics_.warnings.push_back(fmt::format(
        "contact '{}': a step was divided into 1000 parts for the impacts in "
        "it, and its remainder was taken in one: their restitution may be "
        "wrong; use shorter steps, softer contacts or fewer impact_steps",
        model_.pairs[*pair].name));
  }
}

// Plans the steps to the next breakpoint.
void TimeLoop::enter_breakpoint(SystemState& state) {
  origin_ = state.t;
  const double span = breakpoints_[next_].time - origin_;
  const double longest = find_longest_step(settings_, origin_);
  parts_ = count_parts(origin_, breakpoints_[next_].time, longest);
  part_ = 0;
  try {
    if (is_adaptive() && !has_started_) {
      control_.begin(find_first_step(model_, state, control_.allowed()));
    }
    h_ = is_adaptive() ? plan_free_step(state, span).length
                       : span / static_cast<double>(parts_);
    if (!has_started_) {
      const auto impulse = stepper_.start(state, h_);
      if (impulse) {
        statistics_.warnings.push_back(describe(*impulse, state.t, h_));
      }
      calc_terms(model_, state, Side::right, terms_);
      clash_ = find_start_clash(model_, state, terms_, h_);
      peaks_.start(state);
      step_observer_.start(state, terms_, impulse ? impulse->dissipated : 0.0,
                           statistics_.events);
      contacts_.include(state, stepper_.touches(), step_observer_,
                        stepper_.flows());
    }
    if (at_jump_) {
      stepper_.cross_jump(state, h_);
      step_observer_.cross_jump(state, stepper_.flows());
      at_jump_ = false;
    }
  } catch (const NumericalError& error) {
    fail(state, h_,
         fmt::format("before the step at t = {:.9g} s: {}", state.t,
                     error.what()));
  }
  has_started_ = true;
}

// Visits outputs within the step that ended at `state`.
void TimeLoop::visit_within(const SystemState& begin, const SystemState& state,
                            const Losses& before, const Visit& visit) {
  const double h = state.t - begin.t;
  const StepResult& step = stepper_.last();
  for (; output_ < outputs_.size() && outputs_[output_] <= state.t; ++output_) {
    const double t = outputs_[output_];
    if (t == state.t) {
      visit_output(state, losses(), visit);
      continue;
    }
    const double s = (t - begin.t) / h;
    interpolate(model_, begin, state, s, within_);
    within_.t = t;
    // Powers are assumed linear over a step.
    const double rise = 0.5 * s * s * h;
    const Losses losses{
        before.work + s * h * step.begin.loads +
            rise * (step.end.loads - step.begin.loads),
        before.dissipated + s * h * step.begin.dissipated +
            rise * (step.end.dissipated - step.begin.dissipated)};
    visit_output(within_, losses, visit);
  }
}

void TimeLoop::visit_output(const SystemState& state, const Losses& losses,
                            const Visit& visit) {
  const StepTimer::Clock::time_point begin = StepTimer::Clock::now();
  visit(state, losses);
  ++visits_;
  timer_.add_output(begin);
}

// Samples at the start, before the first step.
void TimeLoop::begin(SystemState& state) {
  check(state);
  sampling_.skip_until(state);
  take_samples(state);
  inputs_jump_ = false;
}

void TimeLoop::leave_breakpoint(const SystemState& state, const Visit& visit) {
  const Breakpoint& mark = breakpoints_[next_];
  at_jump_ = mark.is_jump || inputs_jump_;
  inputs_jump_ = false;
  if (at_jump_) peaks_.cross_jump(state);
  if (mark.is_output) visit_output(state, losses(), visit);
  ++next_;
  part_ = parts_ = 0;
}

void TimeLoop::run(SystemState& state, const Visit& visit,
                   const Progress& progress, const CheckpointKeeper& keeper) {
  try {
    if (!has_started_) {
      if (keeper.keep) hold_checkpoint(state, keeper);
      begin(state);
      if (starts_with_output_) visit_output(state, losses(), visit);
    }
    while (next_ < breakpoints_.size()) {
      take_step(state, visit, progress, keeper);
    }
  } catch (const Interrupted&) {
    keep_checkpoint(keeper);
    throw;
  }
}

bool TimeLoop::run_to(double t, SystemState& state,
                      const std::function<bool()>& stops) {
  const auto ignore = [](const SystemState&, const Losses&) {};
  if (!has_started_) begin(state);
  const AddedBreakpoint target = add_breakpoint(t);
  while (next_ <= target.index && !stops()) {
    try {
      take_step(state, ignore, {}, {});
    } catch (...) {
      remove_breakpoint(target);
      throw;
    }
  }
  const bool is_there = next_ > target.index;
  remove_breakpoint(target);
  return is_there;
}

TimeLoop::AddedBreakpoint TimeLoop::add_breakpoint(double t) {
  const double same = find_same_time(t, start_);
  std::size_t i = next_;
  while (i + 1 < breakpoints_.size() && breakpoints_[i].time < t - same) ++i;
  if (std::abs(breakpoints_[i].time - t) <= same) return {i, false};
  if (i == next_) part_ = parts_ = 0;
  breakpoints_.insert(breakpoints_.begin() + static_cast<std::ptrdiff_t>(i),
                      {.time = t});
  return {i, true};
}

void TimeLoop::remove_breakpoint(const AddedBreakpoint& added) {
  if (!added.is_new) return;
  breakpoints_.erase(breakpoints_.begin() +
                     static_cast<std::ptrdiff_t>(added.index));
  if (next_ > added.index) {
    --next_;
  } else if (next_ == added.index) {
    part_ = parts_ = 0;
  }
}

// One step, or one attempt that must be repeated.
void TimeLoop::take_step(SystemState& state, const Visit& visit,
                         const Progress& progress,
                         const CheckpointKeeper& keeper) {
  if (parts_ == 0) enter_breakpoint(state);
  if (!is_adaptive()) {
    take_planned_step(state, progress);
  } else if (!take_free_step(state, visit)) {
    return check_stop_within_step(state, progress);
  }
  if (is_look_due(state, ++statistics_.steps)) inspect(state);
  check(state);
  if (part_ == parts_) leave_breakpoint(state, visit);
  report_progress(state, progress);
  if (is_refresh_due()) {
    refresh();
    if (keeper.keep) hold_checkpoint(state, keeper);
    const std::chrono::duration<double> since = Clock::now() - kept_;
    if (since.count() >= keeper.interval) keep_checkpoint(keeper);
  }
  if (next_ < breakpoints_.size() && pulse_.ends_here()) end_here(state);
}

void TimeLoop::report_progress(const SystemState& state,
                               const Progress& progress) {
  if (pulse_.is_due()) pulse_.report(find_fraction(state.t), progress);
}

// After a part of a step, or an attempt that must be repeated.
void TimeLoop::check_stop_within_step(const SystemState& state,
                                      const Progress& progress) {
  report_progress(state, progress);
  if (pulse_.ends_within_step()) end_here(state);
}

void TimeLoop::end_here(const SystemState& state) const {
  throw Interrupted(fmt::format("{} at t = {:.9g} s", pulse_.words(), state.t));
}

}  // namespace limber::dynamics
