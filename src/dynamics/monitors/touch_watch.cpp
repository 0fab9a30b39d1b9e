// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/monitors/touch_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "limber/common/errors.hpp"
#include "limber/dynamics/equations/pair_forces.hpp"
#include "limber/dynamics/integrators/interpolation.hpp"

namespace limber::dynamics {
namespace {

// Steps of conservative advancement through one step of time, at most.
constexpr int kMostLooks = 1000;
// Factor on the speeds at a step's ends that bounds those between them [-].
constexpr double kSpeedMargin = 1.5;
// Way in a step, relative to that at the present rate, that counts as none [-].
constexpr double kNoWay = 1e-4;
constexpr double kLeastWay = 1e-12;  // [m]
// Fraction of a step between looks at two that part [-].
constexpr double kLeastAdvance = 1.0 / 64.0;

// Touches that last longer, in T_c, are no impacts [-].
constexpr double kRest = 8.0;
// Steps of an impact that is shorter than them.
constexpr int kStepsOfCoarseImpact = 3;
// Way in one step relative to the bodies' size there, at most [-].
constexpr double kMostWay = 0.25;

double find_speed_bound(const SystemModel& model, const Pair& pair,
                        const joints::Touching& law, const SystemState& state) {
  const joints::PairBody A = find_pair_body(model, state, pair.body_A);
  const joints::PairBody B = find_pair_body(model, state, pair.body_B);
  return law.find_speed_bound({A, B});
}

double find_clearance(const SystemModel& model, const Pair& pair,
                      const joints::Touching& law, const SystemState& state) {
  const joints::PairBody A = find_pair_body(model, state, pair.body_A);
  const joints::PairBody B = find_pair_body(model, state, pair.body_B);
  return law.find_clearance({A, B});
}

}  // namespace

TouchWatch::TouchWatch(const SystemModel& model) : model_(model) {
  for (std::size_t p = 0; p < model.pairs.size(); ++p) {
    const joints::Touching* law = model.pairs[p].law->touching();
    if (law == nullptr) continue;
    pairs_.push_back({.pair = p,
                      .law = law,
                      .scratch = make_response(model, model.pairs[p])});
  }
  if (!pairs_.empty()) within_ = make_state(model);
}

void TouchWatch::start(SystemState& state, std::vector<Event>& events) {
  if (!pairs_.empty()) within_ = state;  // so that no step allocates
  pass_all(state, events);
}

joints::PairTouch TouchWatch::find_touch(Watched& watched,
                                         const SystemState& state) {
  const Pair& pair = model_.pairs[watched.pair];
  const joints::PairBody A = find_pair_body(model_, state, pair.body_A);
  const joints::PairBody B = find_pair_body(model_, state, pair.body_B);
  return watched.law->find_touch({A, B}, watched.scratch);
}

joints::PairTouch TouchWatch::find_touch(std::size_t index,
                                         const SystemState& state) {
  return find_touch(pairs_[index], state);
}

joints::TouchReading TouchWatch::read(std::size_t index,
                                      const SystemState& state) {
  Watched& watched = pairs_[index];
  const Pair& pair = model_.pairs[watched.pair];
  const joints::PairBody A = find_pair_body(model_, state, pair.body_A);
  const joints::PairBody B = find_pair_body(model_, state, pair.body_B);
  return watched.law->read({A, B}, now_of(state), memory_of(pair, state),
                           watched.scratch);
}

// By conservative advancement.
std::optional<double> TouchWatch::find_touch_share(Watched& watched,
                                                   const SystemState& before,
                                                   const SystemState& after) {
  const Pair& pair = model_.pairs[watched.pair];
  const double h = after.t - before.t;
  const double speed =
      kSpeedMargin *
      std::max(find_speed_bound(model_, pair, *watched.law, before),
               find_speed_bound(model_, pair, *watched.law, after));
  const double reach = speed * h;
  double clearance = find_clearance(model_, pair, *watched.law, before);
  if (clearance > reach) return std::nullopt;
  const double none = kNoWay * reach + kLeastWay;
  // The rate where two have just left each other may be that of a feature that
  // is no longer the nearest.
  const bool parts =
      clearance <= none &&
      (watched.since == before.t || find_touch(watched, before).rate <= 0);
  double least = parts ? kLeastAdvance : 0.0;
  double share = 0.0;
  for (int i = 0; i < kMostLooks && (clearance > none || least > 0.0); ++i) {
    share += std::max(clearance / reach, least);
    if (share >= 1.0) return std::nullopt;
    interpolate(model_, before, after, share, within_);
    clearance = find_clearance(model_, pair, *watched.law, within_);
    // Two that have just left each other are still close.
    const bool overlaps =
        clearance <= 0.0 && find_touch(watched, within_).depth > 0.0;
    if (clearance > none || overlaps) least = 0.0;
  }
  return share;
}

// A pair that has just touched may still be apart by round-off of the place
// where it did, but goes on to approach.
bool TouchWatch::has_left(Watched& watched, const SystemState& after) {
  const joints::PairTouch touch = find_touch(watched, after);
  return !(touch.depth > 0.0) && touch.rate <= 0.0;
}

// By bisection: the pair touches before and is apart after.
double TouchWatch::find_leave_share(Watched& watched, const SystemState& before,
                                    const SystemState& after) {
  double low = 0.0;
  double high = 1.0;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    interpolate(model_, before, after, middle, within_);
    const bool touches = find_touch(watched, within_).depth > 0.0;
    (touches ? low : high) = middle;
  }
  return high;
}

std::optional<TouchWatch::Crossing> TouchWatch::find_first(
    const SystemState& before, const SystemState& after) {
  std::optional<Crossing> first;
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    Watched& watched = pairs_[i];
    std::optional<double> share;
    if (!watched.is_touching) {
      share = find_touch_share(watched, before, after);
    } else if (has_left(watched, after)) {
      share = find_leave_share(watched, before, after);
    }
    if (share && (!first || *share < first->share)) first = Crossing{i, *share};
  }
  return first;
}

bool TouchWatch::is_coarse(double h, double t) const {
  return std::any_of(pairs_.begin(), pairs_.end(), [&](const Watched& watched) {
    const double lasts = kRest * watched.impact_duration;
    const bool is_impact =
        t - watched.since <= lasts || watched.steps < kStepsOfCoarseImpact;
    return watched.is_touching && is_impact &&
           h * kFewestSteps > watched.impact_duration;
  });
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

void TouchWatch::accept(const SystemState& state) {
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
  const Watched& watched = pairs_[index];
  const double speed =
      find_speed_bound(model_, model_.pairs[watched.pair], *watched.law, state);
  return 2.0 * kNoWay * kSpeedMargin * speed * h + 2.0 * kLeastWay;
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
  if (!watched.is_touching) return;
  const joints::PairBody A = find_pair_body(model_, state, pair.body_A);
  const joints::PairBody B = find_pair_body(model_, state, pair.body_B);
  watched.rate = touch.rate;
  watched.steps = 0;
  watched.impact_duration = watched.law->begin_touch(
      {A, B}, state.t, memory_of(pair, state), watched.scratch);
}

double TouchWatch::find_longest_step(double t) const {
  double longest = std::numeric_limits<double>::infinity();
  for (const Watched& watched : pairs_) {
    const double lasts = kRest * watched.impact_duration;
    if (!watched.is_touching || t - watched.since > lasts) continue;
    longest = std::min(longest, watched.impact_duration / kStepsOfImpact);
  }
  return longest;
}

void TouchWatch::pass_all(SystemState& state, std::vector<Event>& events) {
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    Watched& watched = pairs_[i];
    const bool changes = watched.is_touching
                             ? has_left(watched, state)
                             : find_touch(watched, state).depth > 0.0;
    if (changes) pass(i, state, events);
  }
}

void TouchWatch::exchange_memory(Archive& archive) {
  for (Watched& watched : pairs_) {
    archive(watched.is_touching, watched.since, watched.impact_duration,
            watched.rate, watched.steps);
  }
}

}  // namespace limber::dynamics
