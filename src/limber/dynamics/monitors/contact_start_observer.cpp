// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/monitors/contact_start_observer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/common/restitution.hpp"
#include "limber/dynamics/equations/pair_forces.hpp"
#include "limber/dynamics/system/interpolation.hpp"

namespace limber::dynamics {
namespace {

// Largest number of advancements through one step of time.
constexpr int kMostLooks = 1000;
// Factor on the speeds at a step's ends that bounds those between them [-].
constexpr double kSpeedMargin = 1.5;
// Distance that counts as zero, over the motion in a step, or over the bodies'
// size there, if that is smaller [-].
constexpr double kNoWay = 1e-4;
// Round-off of places in distances, of the places [-].
constexpr double kRounding = 16.0 * std::numeric_limits<double>::epsilon();
// Fraction of a step between looks at separating bodies, and the largest one
// for bodies whose boxes meet but whose surfaces nowhere face each other [-].
constexpr double kLeastAdvance = 1.0 / 64.0;
constexpr double kMostAdvance = 1.0 / 4.0;
// Number of evaluations after which conservative advancement continues by
// parts, and the largest part, relative to the smaller body's size [-].
constexpr int kPatience = 100;
constexpr double kPartOfSize = 0.05;

// Touches of a longer duration, in T_c, are not impacts [-].
constexpr double kRest = 8.0;
// Number of steps for an impact that is shorter than one.
constexpr int kStepsOfCoarseImpact = 3;
// Largest motion in one step, relative to the bodies' size there [-].
constexpr double kMostWay = 0.25;
// Depth from which two bodies cannot separate within a step, likewise [-].
constexpr double kInseparable = 2.0 * kMostWay;

bool has_place(const joints::PairTouch& touch) {
  return !touch.normal_W.isZero(0.0);
}

}  // namespace

ContactStartObserver::ContactStartObserver(const SystemModel& model)
    : model_(model), travel_(model), mobility_(model) {
  for (std::size_t p = 0; p < model.pairs.size(); ++p) {
    const joints::Touching* law = model.pairs[p].law->touching();
    if (law == nullptr) continue;
    pairs_.push_back({.pair = p,
                      .law = law,
                      .scratch = make_response(model, model.pairs[p]),
                      .motion = PairMotion(model, model.pairs[p])});
    travel_.include(model, model.pairs[p].body_A, law->find_reach_A());
    travel_.include(model, model.pairs[p].body_B, law->find_reach_B());
  }
  first_speeds_.resize(model.bodies.size());
  ways_.resize(model.bodies.size());
  if (!pairs_.empty()) within_ = make_state(model);
}

void ContactStartObserver::start(SystemState& state,
                                 std::vector<Event>& events) {
  state.far_pairs.assign(model_.pairs.size(), 0);
  if (!pairs_.empty()) within_ = state;  // so that no step allocates
  pass_all(state, events);
}

joints::PairTouch ContactStartObserver::find_touch(Observed& observed,
                                                   const SystemState& state) {
  return observed.law->find_touch(set_motion(observed, state),
                                  observed.scratch);
}

joints::PairBodies ContactStartObserver::set_motion(
    Observed& observed, const SystemState& state) const {
  return observed.motion.set(model_, model_.pairs[observed.pair], state);
}

double ContactStartObserver::find_speed_bound(Observed& observed,
                                              const SystemState& state) const {
  return observed.law->find_speed_bound(set_motion(observed, state));
}

double ContactStartObserver::find_clearance(Observed& observed,
                                            const SystemState& state) const {
  return observed.law->find_clearance(set_motion(observed, state));
}

joints::PairTouch ContactStartObserver::find_touch(std::size_t index,
                                                   const SystemState& state) {
  return find_touch(pairs_[index], state);
}

joints::TouchReading ContactStartObserver::read(std::size_t index,
                                                const SystemState& state) {
  Observed& observed = pairs_[index];
  const Pair& pair = model_.pairs[observed.pair];
  return observed.law->read(set_motion(observed, state), now_of(state),
                            memory_of(pair, state), observed.scratch);
}

double ContactStartObserver::find_rounding(const Observed& observed,
                                           const SystemState& state) const {
  const Pair& pair = model_.pairs[observed.pair];
  double places = observed.law->find_size();
  for (const BodyIndex b : {pair.body_A, pair.body_B}) {
    if (b != kWorld) places += state.bodies[index(b)].p_WB.norm();
  }
  return kRounding * places;
}

template <typename Predicate>
double ContactStartObserver::bisect(const SystemState& before,
                                    const SystemState& after, double low,
                                    double high, const Predicate& is_early) {
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    interpolate(model_, before, after, middle, within_);
    (is_early() ? low : high) = middle;
  }
  return high;
}

// Fraction of a step between evaluations of two close bodies; 0: to be found by
// conservative advancement.
double ContactStartObserver::find_least_advance(Observed& observed,
                                                const SystemState& before,
                                                double part_of_size) {
  const joints::PairTouch touch = find_touch(observed, before);
  if (!has_place(touch)) {
    return std::clamp(part_of_size, kLeastAdvance, kMostAdvance);
  }
  // Just after a leave the rate may belong to a feature that is no longer the
  // nearest.
  const bool parts = observed.since == before.t || touch.rate <= 0.0;
  return parts ? kLeastAdvance : 0.0;
}

// By conservative advancement; where that is slow, as for bodies that pass
// closely, by parts of the motion in which neither passes through the other.
std::optional<double> ContactStartObserver::find_touch_fraction(
    Observed& observed, const SystemState& before, const SystemState& after) {
  const double h = after.t - before.t;
  const double speed =
      kSpeedMargin * std::max(find_speed_bound(observed, before),
                              find_speed_bound(observed, after));
  const double reach = speed * h;
  double clearance = find_clearance(observed, before);
  if (clearance > reach) return std::nullopt;
  const double size = observed.law->find_size();
  const double none =
      kNoWay * std::min(reach, size) + find_rounding(observed, before);
  observed.near = 2.0 * none;
  const double part_of_size = kPartOfSize * size / reach;
  const double part = std::min(kLeastAdvance, part_of_size);
  double least = clearance <= none
                     ? find_least_advance(observed, before, part_of_size)
                     : 0.0;
  double fraction = 0.0;
  for (int i = 0; i < kMostLooks && (clearance > none || least > 0.0); ++i) {
    const double sure = std::max(clearance / reach, least);
    if (fraction + sure >= 1.0) return std::nullopt;
    if (i >= kPatience && sure < part) {
      const double next = std::min(fraction + part, 1.0);
      interpolate(model_, before, after, next, within_);
      clearance = find_clearance(observed, within_);
      if (clearance <= 0.0) {
        return bisect(before, after, fraction, next,
                      [&] { return find_clearance(observed, within_) > 0.0; });
      }
      if (next == 1.0) return std::nullopt;
      fraction = next;
      continue;
    }
    fraction += sure;
    interpolate(model_, before, after, fraction, within_);
    clearance = find_clearance(observed, within_);
    // Two bodies that have just separated are still close, as those that rest
    // on each other from the start are: within a part of a step even slow ones
    // get deep in a stiff contact.
    const auto overlaps = [&] {
      return find_touch(observed, within_).depth > 0.0;
    };
    if (clearance <= 0.0 && overlaps()) {
      return bisect(before, after, fraction - sure, fraction,
                    [&] { return !overlaps(); });
    }
    if (clearance > none) least = 0.0;
  }
  return fraction;
}

// A pair that has just touched may still be apart by the round-off of its
// places, but continues to approach.
bool ContactStartObserver::has_left(Observed& observed,
                                    const SystemState& after) {
  const joints::PairTouch touch = find_touch(observed, after);
  return !(touch.depth > 0.0) && touch.rate <= 0.0;
}

// The pair touches before and is apart after.
double ContactStartObserver::find_leave_fraction(Observed& observed,
                                                 const SystemState& before,
                                                 const SystemState& after) {
  return bisect(before, after, 0.0, 1.0,
                [&] { return find_touch(observed, within_).depth > 0.0; });
}

std::optional<ContactStartObserver::Crossing> ContactStartObserver::find_first(
    const SystemState& before, const SystemState& after) {
  std::optional<Crossing> first;
  find_ways(before, after);
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    Observed& observed = pairs_[i];
    std::optional<double> fraction;
    observed.is_clear = is_clear(observed, before);
    if (observed.is_clear) continue;
    if (!observed.is_touching) {
      fraction = find_touch_fraction(observed, before, after);
    } else if (has_left(observed, after)) {
      fraction = find_leave_fraction(observed, before, after);
    }
    if (fraction && (!first || *fraction < first->fraction))
      first = Crossing{i, *fraction};
  }
  return first;
}

void ContactStartObserver::find_ways(const SystemState& before,
                                     const SystemState& after) {
  travel_.find_speeds(model_, before, first_speeds_);
  travel_.find_speeds(model_, after, ways_);
  for (std::size_t b = 0; b < ways_.size(); ++b) {
    ways_[b] = kSpeedMargin * (after.t - before.t) *
               std::max(first_speeds_[b], ways_[b]);
  }
}

// Whether a pair cannot touch in its motion from `before` on.
bool ContactStartObserver::is_clear(Observed& observed,
                                    const SystemState& before) {
  if (observed.is_touching) return false;
  const Pair& pair = model_.pairs[observed.pair];
  const double gone = travel_.find_way(pair.body_A, pair.body_B);
  const double way =
      value_of(ways_, pair.body_A) + value_of(ways_, pair.body_B);
  if (gone + way < observed.look_at) return true;
  observed.look_at = gone + find_clearance(observed, before);
  return gone + way < observed.look_at;
}

void ContactStartObserver::mark_apart(SystemState& state) const {
  if (pairs_.empty()) return;
  state.far_pairs.resize(model_.pairs.size());
  for (const Observed& observed : pairs_) {
    state.far_pairs[observed.pair] = observed.is_touching ? 0 : 1;
  }
}

// The touch that fulfils the predicate and has the shortest T_c, if any.
template <typename Predicate>
const ContactStartObserver::Observed* ContactStartObserver::find_shortest(
    const Predicate& counts) const {
  const Observed* shortest = nullptr;
  for (const Observed& observed : pairs_) {
    if (!observed.is_touching || !counts(observed)) continue;
    if (shortest == nullptr ||
        observed.impact_duration < shortest->impact_duration) {
      shortest = &observed;
    }
  }
  return shortest;
}

bool ContactStartObserver::has_rested(const Observed& observed, double t) {
  return t - observed.since > kRest * observed.impact_duration;
}

ContactStartObserver::Impact ContactStartObserver::find_impact(double h,
                                                               double t) const {
  return describe(find_shortest([&](const Observed& observed) {
                    return !has_rested(observed, t) ||
                           observed.steps < kStepsOfCoarseImpact;
                  }),
                  h);
}

ContactStartObserver::Impact ContactStartObserver::find_touch_in(
    double h) const {
  return describe(find_shortest([](const Observed&) { return true; }), h);
}

ContactStartObserver::Impact ContactStartObserver::describe(
    const Observed* touch, double h) {
  if (touch == nullptr) return {};
  return {touch->impact_duration / h, touch->pair};
}

void ContactStartObserver::check_step(double h, double t) const {
  for (const Observed& observed : pairs_) {
    if (!observed.is_touching) continue;
    const double way = observed.rate * h;
    if (way <= kMostWay * observed.law->find_size()) continue;
    throw NumericalError(fmt::format(
        "contact '{}' at t = {:.9g} s: the bodies approach each other by "
        "{:.3g} m in a step of {:.3g} s and could pass through each other; a "
        "step of {:.2g} s would resolve the impact",
        model_.pairs[observed.pair].name, t, way, h,
        observed.impact_duration / kStepsOfImpact));
  }
}

double ContactStartObserver::find_lost_depth(std::size_t index,
                                             const SystemState& before,
                                             const SystemState& after) {
  Observed& observed = pairs_[index];
  if (!observed.is_touching || has_place(find_touch(observed, after)) ||
      find_clearance(observed, after) > 0.0) {
    return 0.0;
  }
  const double depth = find_touch(observed, before).depth;
  return depth > kInseparable * observed.law->find_size() ? depth : 0.0;
}

void ContactStartObserver::accept(const SystemState& before,
                                  const SystemState& state) {
  find_ways(before, state);
  travel_.advance(ways_);
  for (Observed& observed : pairs_) {
    if (!observed.is_touching) continue;
    observed.rate = find_touch(observed, state).rate;
    ++observed.steps;
  }
}

double ContactStartObserver::find_excess(std::size_t index,
                                         const SystemState& state) {
  const double depth = find_touch(index, state).depth;
  return pairs_[index].is_touching ? -depth : depth;
}

double ContactStartObserver::find_tolerance(std::size_t index,
                                            const SystemState& state,
                                            double h) {
  Observed& observed = pairs_[index];
  if (!observed.is_touching) return observed.near;
  const double way = kSpeedMargin * h * find_speed_bound(observed, state);
  return 2.0 * (kNoWay * std::min(way, observed.law->find_size()) +
                find_rounding(observed, state));
}

bool ContactStartObserver::is_deep(std::size_t index,
                                   const SystemState& state) {
  Observed& observed = pairs_[index];
  return find_touch(observed, state).depth >
         kPartOfSize * observed.law->find_size();
}

void ContactStartObserver::pass(std::size_t index, SystemState& state,
                                std::vector<Event>& events) {
  Observed& observed = pairs_[index];
  const Pair& pair = model_.pairs[observed.pair];
  observed.is_touching = !observed.is_touching;
  const joints::PairTouch touch = find_touch(observed, state);
  events.push_back({state.t, pair.name,
                    observed.is_touching ? "touched" : "left", touch.rate});
  observed.since = state.t;
  observed.is_clear = false;
  state.far_pairs[observed.pair] = 0;
  if (!observed.is_touching) {
    observed.law->end_touch(memory_of(pair, state));
    return;
  }
  observed.rate = touch.rate;
  observed.steps = 0;
  observed.impact_duration =
      observed.law->begin_touch(set_motion(observed, state), state.t,
                                memory_of(pair, state), observed.scratch);
  if (!mobility_.is_joined(observed.pair)) return;
  const double duration = std::isfinite(observed.impact_duration)
                              ? observed.impact_duration
                              : kImpactDuration;
  observed.law->set_mobility(
      mobility_.find(model_, state, observed.pair, M_PI / duration),
      memory_of(pair, state));
}

double ContactStartObserver::find_longest_step(double t) const {
  const Impact impact = describe(find_shortest([&](const Observed& observed) {
                                   return !has_rested(observed, t);
                                 }),
                                 1.0);
  return impact.steps / kStepsOfImpact;
}

double ContactStartObserver::find_first_step(double parts, double slow) const {
  const Impact impact =
      describe(find_shortest([slow](const Observed& observed) {
                 return observed.steps <= 1 && observed.rate > slow;
               }),
               1.0);
  return impact.steps / parts;
}

void ContactStartObserver::pass_all(SystemState& state,
                                    std::vector<Event>& events) {
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    Observed& observed = pairs_[i];
    if (observed.is_clear) continue;
    const bool changes = observed.is_touching
                             ? has_left(observed, state)
                             : find_touch(observed, state).depth > 0.0;
    if (changes) pass(i, state, events);
  }
}

void ContactStartObserver::refresh() {
  for (Observed& observed : pairs_) observed.look_at = 0.0;
}

void ContactStartObserver::exchange_memory(Archive& archive) {
  for (Observed& observed : pairs_) {
    archive(observed.is_touching, observed.since, observed.impact_duration,
            observed.rate, observed.steps);
  }
  refresh();
}

}  // namespace limber::dynamics
