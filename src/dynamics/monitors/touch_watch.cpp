// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/monitors/touch_watch.hpp"

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

TouchWatch::TouchWatch(const SystemModel& model)
    : model_(model), travel_(model), mobility_(model) {
  for (std::size_t p = 0; p < model.pairs.size(); ++p) {
    const joints::Touching* law = model.pairs[p].law->touching();
    if (law == nullptr) continue;
    pairs_.push_back({.pair = p,
                      .law = law,
                      .scratch = make_response(model, model.pairs[p]),
                      .motion = PairMotion(model, model.pairs[p])});
    travel_.include(model.pairs[p].body_A, law->find_reach_A());
    travel_.include(model.pairs[p].body_B, law->find_reach_B());
  }
  first_speeds_.resize(model.bodies.size());
  ways_.resize(model.bodies.size());
  if (!pairs_.empty()) within_ = make_state(model);
}

void TouchWatch::start(SystemState& state, std::vector<Event>& events) {
  state.far_pairs.assign(model_.pairs.size(), 0);
  if (!pairs_.empty()) within_ = state;  // so that no step allocates
  pass_all(state, events);
}

joints::PairTouch TouchWatch::find_touch(Watched& watched,
                                         const SystemState& state) {
  return watched.law->find_touch(set_motion(watched, state), watched.scratch);
}

joints::PairBodies TouchWatch::set_motion(Watched& watched,
                                          const SystemState& state) const {
  return watched.motion.set(model_, model_.pairs[watched.pair], state);
}

double TouchWatch::find_speed_bound(Watched& watched,
                                    const SystemState& state) const {
  return watched.law->find_speed_bound(set_motion(watched, state));
}

double TouchWatch::find_clearance(Watched& watched,
                                  const SystemState& state) const {
  return watched.law->find_clearance(set_motion(watched, state));
}

joints::PairTouch TouchWatch::find_touch(std::size_t index,
                                         const SystemState& state) {
  return find_touch(pairs_[index], state);
}

joints::TouchReading TouchWatch::read(std::size_t index,
                                      const SystemState& state) {
  Watched& watched = pairs_[index];
  const Pair& pair = model_.pairs[watched.pair];
  return watched.law->read(set_motion(watched, state), now_of(state),
                           memory_of(pair, state), watched.scratch);
}

double TouchWatch::find_rounding(const Watched& watched,
                                 const SystemState& state) const {
  const Pair& pair = model_.pairs[watched.pair];
  double places = watched.law->find_size();
  for (const BodyIndex b : {pair.body_A, pair.body_B}) {
    if (b != kWorld) places += state.bodies[index(b)].p_WB.norm();
  }
  return kRounding * places;
}

template <typename Predicate>
double TouchWatch::bisect(const SystemState& before, const SystemState& after,
                          double low, double high, const Predicate& is_early) {
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    interpolate(model_, before, after, middle, within_);
    (is_early() ? low : high) = middle;
  }
  return high;
}

// Fraction of a step between evaluations of two close bodies; 0: to be found by
// conservative advancement.
double TouchWatch::find_least_advance(Watched& watched,
                                      const SystemState& before,
                                      double part_of_size) {
  const joints::PairTouch touch = find_touch(watched, before);
  if (!has_place(touch)) {
    return std::clamp(part_of_size, kLeastAdvance, kMostAdvance);
  }
  // Just after a leave the rate may belong to a feature that is no longer the
  // nearest.
  const bool parts = watched.since == before.t || touch.rate <= 0.0;
  return parts ? kLeastAdvance : 0.0;
}

// By conservative advancement; where that is slow, as for bodies that pass
// closely, by parts of the motion in which neither passes through the other.
std::optional<double> TouchWatch::find_touch_share(Watched& watched,
                                                   const SystemState& before,
                                                   const SystemState& after) {
  const double h = after.t - before.t;
  const double speed =
      kSpeedMargin * std::max(find_speed_bound(watched, before),
                              find_speed_bound(watched, after));
  const double reach = speed * h;
  double clearance = find_clearance(watched, before);
  if (clearance > reach) return std::nullopt;
  const double size = watched.law->find_size();
  const double none =
      kNoWay * std::min(reach, size) + find_rounding(watched, before);
  watched.near = 2.0 * none;
  const double part_of_size = kPartOfSize * size / reach;
  const double part = std::min(kLeastAdvance, part_of_size);
  double least = clearance <= none
                     ? find_least_advance(watched, before, part_of_size)
                     : 0.0;
  double share = 0.0;
  for (int i = 0; i < kMostLooks && (clearance > none || least > 0.0); ++i) {
    const double sure = std::max(clearance / reach, least);
    if (share + sure >= 1.0) return std::nullopt;
    if (i >= kPatience && sure < part) {
      const double next = std::min(share + part, 1.0);
      interpolate(model_, before, after, next, within_);
      clearance = find_clearance(watched, within_);
      if (clearance <= 0.0) {
        return bisect(before, after, share, next,
                      [&] { return find_clearance(watched, within_) > 0.0; });
      }
      if (next == 1.0) return std::nullopt;
      share = next;
      continue;
    }
    share += sure;
    interpolate(model_, before, after, share, within_);
    clearance = find_clearance(watched, within_);
    // Two bodies that have just separated are still close.
    const bool overlaps =
        clearance <= 0.0 && find_touch(watched, within_).depth > 0.0;
    if (clearance > none || overlaps) least = 0.0;
  }
  return share;
}

// A pair that has just touched may still be apart by the round-off of its
// places, but continues to approach.
bool TouchWatch::has_left(Watched& watched, const SystemState& after) {
  const joints::PairTouch touch = find_touch(watched, after);
  return !(touch.depth > 0.0) && touch.rate <= 0.0;
}

// The pair touches before and is apart after.
double TouchWatch::find_leave_share(Watched& watched, const SystemState& before,
                                    const SystemState& after) {
  return bisect(before, after, 0.0, 1.0,
                [&] { return find_touch(watched, within_).depth > 0.0; });
}

std::optional<TouchWatch::Crossing> TouchWatch::find_first(
    const SystemState& before, const SystemState& after) {
  std::optional<Crossing> first;
  find_ways(before, after);
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    Watched& watched = pairs_[i];
    std::optional<double> share;
    watched.is_clear = is_clear(watched, before);
    if (watched.is_clear) continue;
    if (!watched.is_touching) {
      share = find_touch_share(watched, before, after);
    } else if (has_left(watched, after)) {
      share = find_leave_share(watched, before, after);
    }
    if (share && (!first || *share < first->share)) first = Crossing{i, *share};
  }
  return first;
}

void TouchWatch::find_ways(const SystemState& before,
                           const SystemState& after) {
  travel_.find_speeds(model_, before, first_speeds_);
  travel_.find_speeds(model_, after, ways_);
  for (std::size_t b = 0; b < ways_.size(); ++b) {
    ways_[b] = kSpeedMargin * (after.t - before.t) *
               std::max(first_speeds_[b], ways_[b]);
  }
}

// Whether a pair cannot touch in its motion from `before` on.
bool TouchWatch::is_clear(Watched& watched, const SystemState& before) {
  if (watched.is_touching) return false;
  const Pair& pair = model_.pairs[watched.pair];
  const double gone = travel_.find_way(pair.body_A, pair.body_B);
  const double way =
      value_of(ways_, pair.body_A) + value_of(ways_, pair.body_B);
  if (gone + way < watched.look_at) return true;
  watched.look_at = gone + find_clearance(watched, before);
  return gone + way < watched.look_at;
}

void TouchWatch::mark_apart(SystemState& state) const {
  if (pairs_.empty()) return;
  state.far_pairs.resize(model_.pairs.size());
  for (const Watched& watched : pairs_) {
    state.far_pairs[watched.pair] = watched.is_touching ? 0 : 1;
  }
}

// The touch that fulfils the predicate and has the shortest T_c, if any.
template <typename Predicate>
const TouchWatch::Watched* TouchWatch::find_shortest(
    const Predicate& counts) const {
  const Watched* shortest = nullptr;
  for (const Watched& watched : pairs_) {
    if (!watched.is_touching || !counts(watched)) continue;
    if (shortest == nullptr ||
        watched.impact_duration < shortest->impact_duration) {
      shortest = &watched;
    }
  }
  return shortest;
}

bool TouchWatch::has_rested(const Watched& watched, double t) {
  return t - watched.since > kRest * watched.impact_duration;
}

TouchWatch::Impact TouchWatch::find_impact(double h, double t) const {
  return describe(find_shortest([&](const Watched& watched) {
                    return !has_rested(watched, t) ||
                           watched.steps < kStepsOfCoarseImpact;
                  }),
                  h);
}

TouchWatch::Impact TouchWatch::find_touch_in(double h) const {
  return describe(find_shortest([](const Watched&) { return true; }), h);
}

TouchWatch::Impact TouchWatch::describe(const Watched* touch, double h) {
  if (touch == nullptr) return {};
  return {touch->impact_duration / h, touch->pair};
}

void TouchWatch::check_step(double h, double t) const {
  for (const Watched& watched : pairs_) {
    if (!watched.is_touching) continue;
    const double way = watched.rate * h;
    if (way <= kMostWay * watched.law->find_size()) continue;
    throw NumericalError(fmt::format(
        "contact '{}' at t = {:.9g} s: both approach each other by {:.3g} m in "
        "a step of {:.3g} s, and could pass through each other; a step of "
        "{:.2g} s would resolve the impact",
        model_.pairs[watched.pair].name, t, way, h,
        watched.impact_duration / kStepsOfImpact));
  }
}

double TouchWatch::find_lost_depth(std::size_t index, const SystemState& before,
                                   const SystemState& after) {
  Watched& watched = pairs_[index];
  if (!watched.is_touching || has_place(find_touch(watched, after)) ||
      find_clearance(watched, after) > 0.0) {
    return 0.0;
  }
  const double depth = find_touch(watched, before).depth;
  return depth > kInseparable * watched.law->find_size() ? depth : 0.0;
}

void TouchWatch::accept(const SystemState& before, const SystemState& state) {
  find_ways(before, state);
  travel_.advance(ways_);
  for (Watched& watched : pairs_) {
    if (!watched.is_touching) continue;
    watched.rate = find_touch(watched, state).rate;
    ++watched.steps;
  }
}

double TouchWatch::find_excess(std::size_t index, const SystemState& state) {
  const double depth = find_touch(index, state).depth;
  return pairs_[index].is_touching ? -depth : depth;
}

double TouchWatch::find_tolerance(std::size_t index, const SystemState& state,
                                  double h) {
  Watched& watched = pairs_[index];
  if (!watched.is_touching) return watched.near;
  const double way = kSpeedMargin * h * find_speed_bound(watched, state);
  return 2.0 * (kNoWay * std::min(way, watched.law->find_size()) +
                find_rounding(watched, state));
}

bool TouchWatch::is_deep(std::size_t index, const SystemState& state) {
  Watched& watched = pairs_[index];
  return find_touch(watched, state).depth >
         kPartOfSize * watched.law->find_size();
}

void TouchWatch::pass(std::size_t index, SystemState& state,
                      std::vector<Event>& events) {
  Watched& watched = pairs_[index];
  const Pair& pair = model_.pairs[watched.pair];
  watched.is_touching = !watched.is_touching;
  const joints::PairTouch touch = find_touch(watched, state);
  events.push_back({state.t, pair.name,
                    watched.is_touching ? "touched" : "left", touch.rate});
  watched.since = state.t;
  watched.is_clear = false;
  state.far_pairs[watched.pair] = 0;
  if (!watched.is_touching) {
    watched.law->end_touch(memory_of(pair, state));
    return;
  }
  watched.rate = touch.rate;
  watched.steps = 0;
  watched.impact_duration =
      watched.law->begin_touch(set_motion(watched, state), state.t,
                               memory_of(pair, state), watched.scratch);
  if (!mobility_.is_joined(watched.pair)) return;
  const double duration = std::isfinite(watched.impact_duration)
                              ? watched.impact_duration
                              : kImpactDuration;
  watched.law->set_mobility(
      mobility_.find(model_, state, watched.pair, M_PI / duration),
      memory_of(pair, state));
}

double TouchWatch::find_longest_step(double t) const {
  const Impact impact = describe(find_shortest([&](const Watched& watched) {
                                   return !has_rested(watched, t);
                                 }),
                                 1.0);
  return impact.steps / kStepsOfImpact;
}

double TouchWatch::find_first_step(double parts, double slow) const {
  const Impact impact =
      describe(find_shortest([slow](const Watched& watched) {
                 return watched.steps <= 1 && watched.rate > slow;
               }),
               1.0);
  return impact.steps / parts;
}

void TouchWatch::pass_all(SystemState& state, std::vector<Event>& events) {
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    Watched& watched = pairs_[i];
    if (watched.is_clear) continue;
    const bool changes = watched.is_touching
                             ? has_left(watched, state)
                             : find_touch(watched, state).depth > 0.0;
    if (changes) pass(i, state, events);
  }
}

void TouchWatch::refresh() {
  for (Watched& watched : pairs_) watched.look_at = 0.0;
}

void TouchWatch::exchange_memory(Archive& archive) {
  for (Watched& watched : pairs_) {
    archive(watched.is_touching, watched.since, watched.impact_duration,
            watched.rate, watched.steps);
  }
  refresh();
}

}  // namespace limber::dynamics
