// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/stepping/event_stepper.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "limber/common/errors.hpp"
#include "limber/dynamics/equations/energy.hpp"
#include "limber/dynamics/equations/equations.hpp"

namespace limber::dynamics {
namespace {

// Largest number of successive steps that end at events.
constexpr int kMostCut = 32;
// Fraction of a step within which an event is moved to its beginning or end
// [-].
constexpr double kSameEvent = 1e-9;
// Largest number of attempts to end a step where two bodies touch or part, and
// least reduction of its length from one to the next [-].
constexpr int kMostRepeats = 12;
constexpr double kLeastReduction = 0.999;
// Parts of a step for the impacts in it; most_steps bounds those to a
// tolerance.
constexpr int kMostParts = 1000;
constexpr int kUnlimited = std::numeric_limits<int>::max();
// Largest gain of a step in an impact that it does not resolve, and in an
// ongoing touch, relative to the energy of the pair and of its bodies' relative
// motion before it, and the work on these [-].
constexpr double kMostGain = 1e-3;
constexpr double kMostGainInTouch = 1e-2;

}  // namespace

EventStepper::EventStepper(const SystemModel& model,
                           const SimulationSettings& settings,
                           std::vector<Event>& events, double refinement)
    : model_(model),
      integrator_(make_integrator(model, settings)),
      terms_(make_terms(model)),
      observer_(model),
      touches_(model),
      impacts_(model, settings.impact_steps / refinement,
               settings.tolerance > 0.0 ? kUnlimited : kMostParts),
      limits_(model),
      ends_at_limits_(settings.tolerance > 0.0 && !limits_.is_empty()),
      stops_(model, settings.impact_steps / refinement, settings.tolerance),
      turns_(model, settings.integrator != IntegratorKind::energy_conserving),
      commit_pairs_(model),
      events_(events),
      last_flows_(make_flows(model)),
      flows_(last_flows_) {
  for (const Pair& pair : model.pairs) {
    joined_.push_back(find_joined_bodies(pair));
  }
  keeps_before_ =
      settings.tolerance > 0.0 || !observer_.is_empty() || !touches_.is_empty();
  conserves_impacts_ = conserves_impacts(model, settings);
  is_implicit_ = traits_of(settings.integrator).is_implicit;
}

std::optional<DamperImpulse> EventStepper::start(SystemState& state, double h) {
  observer_.start(state, events_);
  std::optional<DamperImpulse> impulse;
  if (is_implicit_) impulse = apply_damper_impulse(model_, h, state);
  if (impulse) {
    losses_.dissipated += impulse->dissipated;
    losses_.work += impulse->work;
    observer_.accept(state);
  }
  touches_.start(state, events_);
  integrator_->start(state, h);
  before_ = state;  // so that no step allocates
  return impulse;
}

void EventStepper::cross_jump(const SystemState& state, double h) {
  integrator_->cross_jump(state, h);
}

void EventStepper::add_last() {
  losses_.work += last_.load_work;
  losses_.dissipated += last_.dissipated;
  flows_ += last_flows_;
}

void EventStepper::add_between_steps(const EnergyFlows& flows) {
  losses_.work += flows.supplied.sum();
  losses_.dissipated += flows.dissipated.sum();
  flows_ += flows;
}

UnresolvedMotion EventStepper::choose_motion(
    double h, const ContactStartObserver::Impact& impact) const {
  const bool rests = impacts_.rests_stiffly(h);
  if (conserves_impacts_ && impacts_.is_struck() && !rests) {
    return UnresolvedMotion::conserved;
  }
  if (impact.steps < ContactStartObserver::kFewestSteps)
    return UnresolvedMotion::ended;
  return rests ? UnresolvedMotion::calmed : UnresolvedMotion::kept;
}

// An impact that the step does not resolve is damped, since it would gain
// energy; the loss counts as dissipated. If it still gains energy, or a badly
// resolved one does, the step fails; so does a step longer than an impact in an
// ongoing touch.
StepResult EventStepper::take_step(SystemState& state, double h, double end) {
  ContactStartObserver::Impact impact = touches_.find_impact(h, state.t);
  const UnresolvedMotion motion = choose_motion(h, impact);
  const bool damps = integrator_->damp(motion);
  const bool is_impact = impact.steps < ContactStartObserver::kSureSteps;
  if (!is_impact) impact = touches_.find_touch_in(h);
  if (motion == UnresolvedMotion::conserved ||
      (!is_impact && !(impact.steps < 1.0))) {
    const StepResult result = integrator_->step(state, h, end);
    last_flows_ = integrator_->flows();
    return result;
  }
  const double before = calc_energy(model_, state, terms_).total();
  const double own_before = find_touch_energy(impact.pair, state);
  StepResult result = integrator_->step(state, h, end);
  last_flows_ = integrator_->flows();
  const double after = calc_energy(model_, state, terms_).total();
  const double gained = after + result.dissipated - result.load_work - before;
  const Eigen::Index row =
      EnergyRows(model_).pairs + static_cast<Eigen::Index>(impact.pair);
  double own_gain = find_touch_energy(impact.pair, state) - own_before +
                    last_flows_.dissipated[row];
  double at_stake = own_before;
  for (const BodyIndex b : joined_[impact.pair]) {
    if (b == kWorld) continue;
    own_gain += last_flows_.dissipated[b] - last_flows_.supplied[b];
    at_stake += std::abs(last_flows_.supplied[b]);
  }
  const double most = is_impact ? kMostGain : kMostGainInTouch;
  if (gained > most * at_stake) {
    take_back(state);
    throw NumericalError(fmt::format(
        "a step of {:.3g} s at t = {:.9g} s, too long for the contact in it, "
        "gains {:.3g} J",
        h, state.t, gained));
  }
  // Not what other bodies lose.
  const double lost = std::max(std::min(-gained, -own_gain), 0.0);
  if (damps) {
    result.dissipated += lost;
    last_flows_.dissipated[row] += lost;
  }
  return result;
}

// Stored in a pair, and in the motion of its bodies beside each other.
// `terms_` are those of `state`.
double EventStepper::find_touch_energy(std::size_t pair,
                                       const SystemState& state) const {
  return terms_.pairs.responses[pair].energy +
         find_relative_kinetic(model_, state, joined_[pair]);
}

// Takes a step; costs of a reverted step remain in `last_`.
void EventStepper::advance(SystemState& state, double h, double end) {
  StepResult next = take_step(state, h, end);
  next.iterations += last_.iterations;
  next.factorizations += last_.factorizations;
  last_ = next;
  const auto failure = turns_.count(integrator_->terms(), h, state);
  if (failure && has_before_) {
    take_back(state);
    throw NumericalError(*failure);
  }
  commit_pairs_(state);
}

void EventStepper::attempt(SystemState& state, double h, double end) {
  events_before_ = events_.size();
  h_ = impacts_.limit(h, touches_);
  const double at_stop = stops_.limit(h, state);
  if (at_stop < h_) {
    is_at_stop_ = true;
    h_ = at_stop;
  } else if (h_ < h) {
    is_at_stop_ = false;
  }
  touches_.check_step(h_, state.t);
  touches_.mark_apart(state);
  has_before_ = keeps_before_ || turns_.may_turn_far(state, h_);
  if (has_before_) before_ = state;
  last_ = {};
  advance(state, h_, h_ < h ? state.t + h_ : end);
  while (const auto other = find_other_length(state)) {
    take_back(state);
    h_ = *other;
    advance(state, h_, h_ < h ? state.t + h_ : end);
  }
}

// Of the attempted step, if it is to be repeated: shorter, or as long by the
// scheme for impacts [s].
std::optional<double> EventStepper::find_other_length(
    const SystemState& state) {
  const auto shorter = impacts_.find_shorter(before_, state, h_, touches_);
  if (shorter) return shorter;
  if (conserves_impacts_ && impacts_.take_onset()) return h_;
  return std::nullopt;
}

void EventStepper::take_back(SystemState& state) {
  state = before_;
  integrator_->undo(state);
}

void EventStepper::pass(const EventObserver::Crossing& crossing,
                        SystemState& state, double h) {
  const EventObserver::Change change =
      observer_.pass(crossing.index, state, events_);
  if (change.coupler >= 0) {
    losses_.dissipated += change.energy_lost;
    flows_.dissipated[EnergyRows(model_).couplers + change.coupler] +=
        change.energy_lost;
  }
  if (change.has_jump) integrator_->start(state, h);
  observer_.accept(state);
}

void EventStepper::pass_all_at_end(SystemState& state, double h) {
  constexpr auto kAtEnd = EventObserver::Changes::at_end;
  while (const auto crossing = observer_.find_first(state, h, kAtEnd)) {
    pass(*crossing, state, h);
  }
  observer_.accept();
  touches_.pass_all(state, events_);
}

// Repeats the attempted step up to a fraction of it. @returns whether it took
// any time
bool EventStepper::advance_to(double fraction, SystemState& state) {
  take_back(state);
  if (!(fraction > kSameEvent)) {
    last_.load_work = last_.dissipated = 0.0;
    last_flows_.clear();
    return false;
  }
  const double until = fraction * h_;
  advance(state, until, state.t + until);
  return true;
}

void EventStepper::settle(SystemState& state, double nominal_h) {
  impacts_.accept(h_);
  if (observer_.is_empty() && touches_.is_empty() && !ends_at_limits_) {
    add_last();
    return;
  }
  const auto crossing = observer_.find_first(state, h_);
  const auto touch = touches_.find_first(before_, state);
  const double limit =
      ends_at_limits_ ? limits_.find_first(before_, state).value_or(1.0) : 1.0;
  const double fraction = std::min({crossing ? crossing->fraction : 1.0,
                                    touch ? touch->fraction : 1.0, limit});
  if (cut_ == kMostCut && touch) check_missed_touch(touch->index, state);
  if (fraction > 1.0 - kSameEvent || cut_ == kMostCut) {
    cut_ = 0;
    add_last();
    pass_all_at_end(state, nominal_h);
    touches_.accept(before_, state);
    return;
  }
  ++cut_;
  int iterations = 1;
  if (touch && touch->fraction == fraction) {
    iterations = settle_touch(*touch, state, nominal_h);
  } else {
    advance_to(fraction, state);
    add_last();
    if (crossing && crossing->fraction == fraction) {
      pass(*crossing, state, nominal_h);
    } else {
      observer_.accept(state);
    }
    touches_.accept(before_, state);
  }
  for (std::size_t i = events_before_; i < events_.size(); ++i) {
    events_[i].iterations = iterations;
  }
}

// A place of contact that appears deep between two bodies that were apart, as
// at edges alongside each other, would add energy.
void EventStepper::check_deep_touch(std::size_t index, SystemState& state) {
  if (touches_.is_touching(index)) return;
  const joints::TouchReading touch = touches_.read(index, state);
  const JoinedBodies& bodies = joined_[touches_.pair_of(index)];
  const double at_stake = find_relative_kinetic(model_, state, bodies);
  if (!(touch.energy > kMostGain * at_stake)) return;
  const double t = state.t;
  take_back(state);
  throw NumericalError(fmt::format(
      "contact '{}' at t = {:.9g} s: the bodies already overlap by {:.3g} m "
      "where their surfaces first face each other, which would add {:.3g} J",
      model_.pairs[touches_.pair_of(index)].name, t, touch.depth,
      touch.energy));
}

// After many cuts touches are moved to a step's end, unless that is deep in
// one.
void EventStepper::check_missed_touch(std::size_t index, SystemState& state) {
  if (touches_.is_touching(index) || !touches_.is_deep(index, state)) return;
  const double t = state.t;
  cut_ = 0;
  take_back(state);
  throw NumericalError(
      fmt::format("contact '{}': a step to t = {:.9g} s ends within a contact "
                  "whose beginning was not found by cutting steps {} times",
                  model_.pairs[touches_.pair_of(index)].name, t, kMostCut));
}

// Two bodies deep in each other cannot separate in a step.
void EventStepper::check_leave(std::size_t index, SystemState& state) {
  const double depth = touches_.find_lost_depth(index, before_, state);
  if (!(depth > 0.0)) return;
  const double t = state.t;
  take_back(state);
  throw NumericalError(fmt::format(
      "contact '{}' at t = {:.9g} s: the bodies overlapped by {:.3g} m, and "
      "their surfaces no longer face each other anywhere; a stiffer contact or "
      "a lower speed would prevent this",
      model_.pairs[touches_.pair_of(index)].name, t, depth));
}

// A step that ends deep in a contact, or after it, gives a poor estimate of its
// beginning: shorter ones improve it, until one ends there. A step that ends
// before the contact is accepted, and the next one continues.
// @returns the number of its repeats
int EventStepper::settle_touch(const ContactStartObserver::Crossing& crossing,
                               SystemState& state, double nominal_h) {
  double fraction = crossing.fraction;
  int repeats = 0;
  while (repeats < kMostRepeats && advance_to(fraction, state)) {
    ++repeats;
    const double tolerance =
        touches_.find_tolerance(crossing.index, state, nominal_h);
    if (touches_.find_excess(crossing.index, state) <= tolerance) break;
    const auto earlier = touches_.find_first(before_, state);
    if (!earlier) break;
    fraction *= std::min(earlier->fraction, kLeastReduction);
  }
  const double excess = touches_.find_excess(crossing.index, state);
  const double tolerance =
      touches_.find_tolerance(crossing.index, state, nominal_h);
  if (excess > tolerance) check_deep_touch(crossing.index, state);
  check_leave(crossing.index, state);
  add_last();
  if (excess >= -tolerance) touches_.pass(crossing.index, state, events_);
  observer_.accept(state);
  touches_.accept(before_, state);
  return repeats;
}

void EventStepper::add_warnings(std::vector<std::string>& warnings) {
  const auto pair = impacts_.take_excess();
  if (!pair) return;
  warnings.push_back(fmt::format(
      "contact '{}': a step was divided into {} parts for the impacts in "
      "it, and its remainder was taken in one: their restitution may be "
      "wrong; use shorter steps, softer contacts or fewer impact_steps",
      model_.pairs[*pair].name, kMostParts));
}

void EventStepper::exchange_memory(Archive& archive, const SystemState& state) {
  integrator_->exchange_memory(archive, state);
  observer_.exchange_memory(archive);
  touches_.exchange_memory(archive);
  impacts_.exchange_memory(archive);
  stops_.exchange_memory(archive);
  archive(cut_, is_at_stop_, losses_.work, losses_.dissipated, flows_);
  if (keeps_before_) before_ = state;
}

}  // namespace limber::dynamics
