// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/driver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/errors.hpp"
#include "dynamics/archives.hpp"
#include "dynamics/interpolation.hpp"
#include "dynamics/interrupted.hpp"
#include "dynamics/trouble.hpp"

namespace limber::dynamics {
namespace {

constexpr int kMostHalvings = 10;
constexpr double kSame = 1e-9;  // of a step: where it ends
constexpr long kMostStepsBetweenProgress = 64;
constexpr long kStepsBetweenLooks = 32;         // at the energy
constexpr long kStepsBetweenCheckpoints = 256;  // at least
constexpr std::chrono::milliseconds kShortSilence(2);
constexpr std::chrono::milliseconds kLongSilence(20);
constexpr std::chrono::seconds kLongestWait(1);  // of who asks for the end
constexpr double kFewestStepsToAMark = 4.0;      // to a tolerance
// Of the whole time: steps to a tolerance do not get shorter.
constexpr double kShortest = 1e-12;

std::vector<double> find_outputs(const SimulationSettings& settings,
                                 double start) {
  std::vector<double> times;
  for (const double t : settings.output_times) {
    if (t > start) times.push_back(t);
  }
  return times;
}

// Steps to a tolerance end where something jumps, not on outputs.
std::vector<Landmark> find_marks(const SystemModel& model, double start,
                                 const SimulationSettings& settings) {
  if (settings.tolerance == 0.0) return find_landmarks(model, start, settings);
  SimulationSettings no_outputs = settings;
  no_outputs.output_times.clear();
  return find_landmarks(model, start, no_outputs);
}

}  // namespace

Driver::Driver(const SystemModel& model, const SimulationSettings& settings,
               const SystemState& state, SimulationStatistics& statistics,
               double refinement, const Followed& followed)
    : model_(model),
      settings_(settings),
      statistics_(statistics),
      start_(state.t),
      starts_with_output_(!settings.output_times.empty() &&
                          settings.output_times.front() <= state.t),
      marks_(find_marks(model, state.t, settings)),
      outputs_(find_outputs(settings, state.t)),
      refinement_(refinement),
      marcher_(model, settings, statistics.events),
      control_(settings.tolerance, settings.end_time - state.t, settings.step,
               refinement),
      peaks_(model, followed),
      audit_(model, settings.integrator),
      budget_(model.bodies.size()),
      terms_(make_terms(model)),
      within_(state),
      kept_(Clock::now()),
      told_(kept_) {}

Losses Driver::losses() const {
  return {marcher_.totals().load_work, marcher_.totals().dissipated};
}

void Driver::exchange_memory(Archive& archive, SystemState& state) {
  archive(state, has_started_, mark_, part_, parts_, origin_, h_, at_jump_,
          depth_, shares_, trouble_, clash_, output_);
  marcher_.exchange_memory(archive, state);
  control_.exchange_memory(archive);
  watch_.exchange_memory(archive);
  peaks_.exchange_memory(archive);
  audit_.exchange_memory(archive);
  exchange_costs(archive, statistics_);
  archive(statistics_.events, statistics_.warnings);
}

void Driver::resume(const Checkpoint& checkpoint, SystemState& state) {
  Archive archive(checkpoint.numbers);
  exchange_memory(archive, state);
}

void Driver::keep_checkpoint(SystemState& state, const CheckpointKeeper& keeper,
                             bool is_last) {
  marcher_.refresh();
  if (!keeper.keep) return;
  const std::chrono::duration<double> since = Clock::now() - kept_;
  if (since.count() < keeper.interval && !is_last) return;
  Archive archive;
  exchange_memory(archive, state);
  keeper.keep({state.t, archive.numbers()});
  kept_ = Clock::now();
}

// Of the work that is done at a time. Steps to a tolerance are not known
// before.
double Driver::find_share(double t) const {
  const double end = settings_.end_time;
  if (settings_.tolerance > 0.0) return (t - start_) / (end - start_);
  return count_steps(settings_, start_, t) /
         count_steps(settings_, start_, end);
}

// Every few milliseconds, however long steps are.
void Driver::tell_progress(const SystemState& state, const Progress& progress) {
  const auto now = Clock::now();
  if (now - told_ < kShortSilence) {
    stride_ = std::min(2 * stride_, kMostStepsBetweenProgress);
  } else if (now - told_ > kLongSilence) {
    stride_ = std::max(stride_ / 2, 1L);
  }
  told_ = now;
  told_step_ = statistics_.steps;
  try {
    report(progress, "simulating", find_share(state.t));
  } catch (const Interrupted& asked) {
    if (!asked_) asked_ = now;
    words_ = asked.what();
  }
}

// Where others may make a checkpoint, or a moment after it was asked for.
bool Driver::ends_here(bool is_even) const {
  return asked_ && (is_even || Clock::now() - *asked_ > kLongestWait);
}

void Driver::fail(const SystemState& state, double h,
                  const std::string& what) const {
  const std::string cause = find_cause(model_, state, settings_.integrator, h);
  throw NumericalError(cause.empty() ? what : what + "; " + cause);
}

void Driver::inspect(const SystemState& state) {
  const double stored = calc_energy(model_, state, terms_).total();
  if (!watch_.is_blown_up(stored, state.t == settings_.end_time)) return;
  const bool is_early = statistics_.steps <= kStepsBetweenLooks;
  const char* advice = settings_.integrator == IntegratorKind::implicit_euler
                           ? "a smaller step may help"
                           : "a smaller step or implicit-euler may help";
  fail(state, h_,
       fmt::format("the motion blows up at t = {:.9g} s: {:.3g} J are stored, "
                   "most in {}, where the start and the loads account for "
                   "{:.3g} J; {}",
                   state.t, stored, find_most_energy(model_, state),
                   watch_.supplied(),
                   is_early && !clash_.empty() ? clash_ : advice));
}

void Driver::count_step(const StepResult& since) {
  const StepResult& now = marcher_.totals();
  statistics_.newton_iterations += now.iterations - since.iterations;
  statistics_.factorizations += now.factorizations - since.factorizations;
  watch_.add(now.load_work - since.load_work);
}

// @param events that there were before the step
void Driver::watch_step(const SystemState& state, std::size_t events) {
  peaks_.include(state);
  const bool is_smooth = statistics_.events.size() == events;
  audit_.include(state, is_smooth ? &marcher_.terms() : nullptr,
                 marcher_.totals(), state.t == settings_.end_time,
                 statistics_.events);
}

void Driver::tell(RunRecord& record) {
  record.peaks = peaks_.finish();
  record.energy = audit_.find_energy();
  for (std::string& text : audit_.find_warnings()) {
    statistics_.warnings.push_back(std::move(text));
  }
}

void Driver::halve(const SystemState& state, double h, const std::string& why) {
  ++statistics_.halved_steps;
  if (++depth_ <= kMostHalvings) return;
  fail(state, h,
       fmt::format("{}; at t = {:.9g} s a step of {:.3g} s, halved {} times, "
                   "did not help",
                   why, state.t, h, kMostHalvings));
}

// What made steps hard: the last failure, or where the energy is.
std::string Driver::describe_trouble(const SystemState& state) const {
  if (!trouble_.empty()) return "the last that failed: " + trouble_;
  return "most energy is in " + find_most_energy(model_, state);
}

void Driver::check_budget(const SystemState& state, double h) const {
  const long steps = statistics_.steps + statistics_.rejected_steps;
  if (budget_.allows_solves(statistics_.linear_solves, steps)) return;
  fail(state, h,
       fmt::format("at t = {:.9g} s: {} steps have taken {} linear solves, "
                   "where 2 or 3 each are usual, and {} halvings; ask for "
                   "shorter steps; {}",
                   state.t, steps, statistics_.linear_solves,
                   statistics_.halved_steps, describe_trouble(state)));
}

// Does a step's work; if it fails, steps are halved.
template <typename Work>
bool Driver::goes_through(const SystemState& state, double h,
                          const Work& work) {
  check_budget(state, h);
  bool fails = false;
  try {
    work();
  } catch (const NumericalError& error) {
    fails = true;
    trouble_ = error.what();
  }
  statistics_.linear_solves += marcher_.take_solves();
  if (fails) halve(state, h, trouble_);
  return !fails;
}

// The steps to the next landmark.
void Driver::enter_mark(SystemState& state) {
  origin_ = state.t;
  const double span = marks_[mark_].time - origin_;
  const double longest = find_longest_step(settings_, origin_);
  parts_ = std::max(
      static_cast<long>(std::ceil(span / longest * (1.0 - 1e-12))), 1L);
  part_ = 0;
  h_ = is_adaptive() ? control_.propose(state, span)
                     : span / static_cast<double>(parts_);
  try {
    if (!has_started_) {
      if (const auto impulse = marcher_.start(state, h_)) {
        statistics_.warnings.push_back(describe(*impulse, state.t, h_));
      }
      const double stored = calc_energy(model_, state, terms_).total();
      watch_ = EnergyWatch(stored);
      clash_ = find_start_clash(model_, terms_, stored, h_);
      peaks_.start(state);
      audit_.start(state, terms_, marcher_.totals(), statistics_.events);
    }
    if (at_jump_) {
      marcher_.cross_jump(state, h_);
      audit_.cross_jump(state, marcher_.terms());
    }
  } catch (const NumericalError& error) {
    fail(state, h_,
         fmt::format("before the step at t = {:.9g} s: {}", state.t,
                     error.what()));
  }
  has_started_ = true;
}

// A run that is halved on and on takes a thousand times as long as was asked
// for.
void Driver::count_share(const SystemState& state) {
  if (budget_.allows_shares(++shares_, statistics_.steps)) return;
  fail(state, std::ldexp(h_, -depth_),
       fmt::format("at t = {:.9g} s: steps of {:.3g} s go through only when "
                   "they are halved again and again, {} times by now; ask for "
                   "shorter steps or for a tolerance; {}",
                   state.t, h_, statistics_.halved_steps,
                   describe_trouble(state)));
}

// One of equal steps, in parts where something happens or it must be halved.
void Driver::take_planned_step(SystemState& state) {
  // Times come from the landmark, not from a sum of steps.
  const double end = part_ + 1 == parts_
                         ? marks_[mark_].time
                         : origin_ + static_cast<double>(part_ + 1) * h_;
  const StepResult before = marcher_.totals();
  bool is_whole = true;
  while (end - state.t > kSame * h_) {
    const double left = is_whole ? h_ : end - state.t;
    const double h = std::min(left, std::ldexp(h_, -depth_));
    const bool is_last = h >= left * (1.0 - kSame);
    const std::size_t events = statistics_.events.size();
    const bool has_moved = goes_through(state, h, [&] {
      marcher_.attempt(state, is_last ? left : h, is_last ? end : state.t + h);
      marcher_.settle(state, h_);
    });
    is_whole = is_whole && !has_moved;
    if (has_moved) watch_step(state, events);
    if (has_moved && !is_last) count_share(state);
  }
  state.t = end;
  if (depth_ > 0) --depth_;
  count_step(before);
  ++part_;
}

// As long a step as the tolerance allows; whether it counts.
bool Driver::take_free_step(SystemState& state, const Visit& visit) {
  if (statistics_.steps + statistics_.rejected_steps >= settings_.most_steps) {
    fail(
        state, h_,
        fmt::format("at t = {:.9g} s: the tolerance of {:.3g} m takes more "
                    "steps than most_steps allows, {:.3g} s long by now; ask "
                    "for a larger tolerance, a shorter time or more steps; {}",
                    state.t, settings_.tolerance, h_, describe_trouble(state)));
  }
  const double mark = marks_[mark_].time;
  const StepResult before = marcher_.totals();
  const Losses losses_before = losses();
  const double left = mark - state.t;
  // A load that is zero at both ends of a step is not missed.
  const double most = refinement_ * (mark - origin_) / kFewestStepsToAMark;
  h_ = std::min(control_.propose(state, left), std::max(most, 0.0));
  if (left - h_ < kSame * h_) h_ = left;
  if (!(h_ > kShortest * (settings_.end_time - start_))) {
    fail(state, h_,
         fmt::format("body '{}' at t = {:.9g} s: the error of {:.3g} m that a "
                     "step may have asks for steps below {:.3g} s",
                     model_.bodies[marcher_.last().error_body].name, state.t,
                     settings_.tolerance, h_));
  }
  bool counts = false;
  const std::size_t events = statistics_.events.size();
  const bool has_moved = goes_through(state, h_, [&] {
    marcher_.attempt(state, h_, h_ == left ? mark : state.t + h_);
    counts = control_.accepts(h_, marcher_.last().error);
    counts ? marcher_.settle(state, h_) : marcher_.take_back(state);
  });
  if (!has_moved) {
    control_.halve();
    return false;
  }
  depth_ = 0;
  if (!counts) {
    ++statistics_.rejected_steps;
    statistics_.newton_iterations += marcher_.last().iterations;
    statistics_.factorizations += marcher_.last().factorizations;
    return false;
  }
  count_step(before);
  watch_step(state, events);
  visit_within(marcher_.before(), state, losses_before, visit);
  if (mark - state.t <= kSame * h_) {
    state.t = mark;
    part_ = parts_;
  }
  return true;
}

// Outputs within the step that ended at `state`.
void Driver::visit_within(const SystemState& begin, const SystemState& state,
                          const Losses& before, const Visit& visit) {
  const double h = state.t - begin.t;
  const StepResult& step = marcher_.last();
  for (; output_ < outputs_.size() && outputs_[output_] <= state.t; ++output_) {
    const double t = outputs_[output_];
    if (t == state.t) {
      visit(state, losses());
      continue;
    }
    const double s = (t - begin.t) / h;
    interpolate(model_, begin, state, s, within_);
    within_.t = t;
    // Powers change evenly over a step.
    const double rise = 0.5 * s * s * h;
    visit(within_, {before.work + s * h * step.begin.loads +
                        rise * (step.end.loads - step.begin.loads),
                    before.dissipated + s * h * step.begin.dissipated +
                        rise * (step.end.dissipated - step.begin.dissipated)});
  }
}

void Driver::leave_mark(const SystemState& state, const Visit& visit) {
  const Landmark& mark = marks_[mark_];
  at_jump_ = mark.is_jump;
  if (at_jump_) peaks_.cross_jump(state);
  if (mark.is_output) visit(state, losses());
  ++mark_;
  part_ = parts_ = 0;
}

void Driver::run(SystemState& state, const Visit& visit,
                 const Progress& progress, const CheckpointKeeper& keeper) {
  if (!has_started_ && starts_with_output_) visit(state, losses());
  while (mark_ < marks_.size()) {
    if (parts_ == 0) enter_mark(state);
    if (!is_adaptive()) {
      take_planned_step(state);
    } else if (!take_free_step(state, visit)) {
      continue;
    }
    const long steps = ++statistics_.steps;
    if (steps <= kStepsBetweenLooks || steps % kStepsBetweenLooks == 0 ||
        state.t == settings_.end_time) {
      inspect(state);
    }
    if (part_ == parts_) leave_mark(state, visit);
    if (steps - told_step_ >= stride_) tell_progress(state, progress);
    const bool is_even = steps % kStepsBetweenCheckpoints == 0;
    const bool is_last = mark_ < marks_.size() && ends_here(is_even);
    if (is_even || is_last) keep_checkpoint(state, keeper, is_last);
    if (is_last) {
      throw Interrupted(fmt::format("{} at t = {:.9g} s", words_, state.t));
    }
  }
}

std::vector<double> find_visited_times(const SystemModel& model, double start,
                                       const SimulationSettings& settings) {
  if (settings.tolerance > 0.0) return settings.output_times;
  std::vector<double> times;
  const auto& outputs = settings.output_times;
  if (!outputs.empty() && outputs.front() <= start) times.push_back(start);
  for (const Landmark& mark : find_landmarks(model, start, settings)) {
    if (mark.is_output) times.push_back(mark.time);
  }
  return times;
}

}  // namespace limber::dynamics
