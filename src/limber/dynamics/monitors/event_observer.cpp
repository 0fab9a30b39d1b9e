// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/monitors/event_observer.hpp"

#include <cmath>

#include "limber/common/index.hpp"
#include "limber/dynamics/equations/transmission.hpp"

namespace limber::dynamics {
namespace {

// First point in [0, high] where `is_past` becomes true, which it is at `high`.
template <typename IsPast>
double bisect(double high, const IsPast& is_past) {
  double low = 0.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (is_past(middle) ? high : low) = middle;
  }
  return high;
}

// The cubic through the values and rates of a switch at both ends of a step, at
// fractions of the step.
struct SwitchCubic {
  const joints::SwitchValue& a;
  const joints::SwitchValue& b;
  double h;  // [s]

  [[nodiscard]] double value(double s) const {
    const double left = 1.0 - s;
    return left * left * ((1.0 + 2.0 * s) * a.value + s * h * a.rate) +
           s * s * ((1.0 + 2.0 * left) * b.value - left * h * b.rate);
  }
  [[nodiscard]] double slope(double s) const {
    const double left = 1.0 - s;
    return 6.0 * s * left * (b.value - a.value) +
           h * (left * (1.0 - 3.0 * s) * a.rate + s * (3.0 * s - 2.0) * b.rate);
  }

  // Where the sign first is that of a switch that is up, or not.
  [[nodiscard]] double find_root(double until, bool rises) const {
    return bisect(until, [&](double s) { return (value(s) >= 0.0) == rises; });
  }
  // The same within the step, if the switch is there and back at its end.
  [[nodiscard]] std::optional<double> find_excursion(bool rises) const {
    constexpr double kRoundoff = 1e-9;
    const double sign = rises ? 1.0 : -1.0;
    if (!(sign * a.rate > 0.0) || !(sign * b.rate < 0.0)) return std::nullopt;
    const double extreme =
        bisect(1.0, [&](double s) { return sign * slope(s) <= 0.0; });
    const double least = kRoundoff * h * (std::abs(a.rate) + std::abs(b.rate));
    if (!(sign * value(extreme) > least)) return std::nullopt;
    return find_root(extreme, rises);
  }
};

}  // namespace

EventObserver::EventObserver(const SystemModel& model) : model_(model) {
  for (std::size_t c = 0; c < model.couplers.size(); ++c) {
    const int count = joints::switch_count(model.couplers[c].law);
    for (int i = 0; i < count; ++i) {
      Switch s;
      s.coupler = CouplerIndex(c);
      s.index = i;
      s.memory = c;
      s.place = index(i);
      switches_.push_back(s);
    }
  }
  for (std::size_t t = 0; t < model.transmissions.size(); ++t) {
    const auto& laws = model.transmissions[t].laws;
    std::size_t place = 0;
    for (std::size_t law = 0; law < laws.size(); ++law) {
      for (int i = 0; i < joints::switch_count(laws[law]); ++i) {
        Switch s;
        s.transmission = TransmissionIndex(t);
        s.law = law;
        s.index = i;
        s.memory = model.couplers.size() + t;
        s.place = place++;
        switches_.push_back(s);
      }
    }
  }
}

joints::SwitchValue EventObserver::evaluate(const Switch& s,
                                            const SystemState& state) const {
  if (s.coupler >= 0) {
    return joints::find_switch(model_.couplers[index(s.coupler)].law, s.index,
                               find_relative_motion(model_, state, s.coupler),
                               state.memory[index(s.coupler)], state.t);
  }
  const Transmission& transmission =
      model_.transmissions[index(s.transmission)];
  return joints::find_switch(transmission.laws[s.law], s.index,
                             find_motion(model_, state, transmission));
}

void EventObserver::start(SystemState& state, std::vector<Event>& events) {
  for (std::size_t i = 0; i < switches_.size(); ++i) {
    Switch& s = switches_[i];
    set(s, evaluate(s, state).value >= 0.0, state);
    if (!s.is_up || !is_trigger(s)) continue;
    s.is_up = false;
    pass(i, state, events);
  }
  accept(state);
}

std::optional<EventObserver::Crossing> EventObserver::find_first(
    const SystemState& after, double h, Changes changes) {
  std::optional<Crossing> first;
  for (std::size_t i = 0; i < switches_.size(); ++i) {
    Switch& s = switches_[i];
    s.now = evaluate(s, after);
    const SwitchCubic cubic{s.last, s.now, h};
    const bool is_up = s.now.value >= 0.0;
    std::optional<double> fraction;
    if (is_up != s.is_up) {
      fraction = cubic.find_root(1.0, is_up);
    } else if (changes == Changes::within) {
      fraction = cubic.find_excursion(!is_up);
    }
    if (!fraction) continue;
    if (!first || *fraction < first->fraction) first = Crossing{i, *fraction};
  }
  return first;
}

void EventObserver::set(Switch& s, bool is_up, SystemState& state) const {
  s.is_up = is_up;
  if (is_trigger(s)) return;  // the memory stores its effect instead
  state.memory[s.memory].switches[s.place] =
      is_up ? joints::SwitchMode::on : joints::SwitchMode::off;
}

bool EventObserver::is_trigger(const Switch& s) const {
  return s.coupler >= 0 &&
         joints::has_triggers(model_.couplers[index(s.coupler)].law);
}

EventObserver::Change EventObserver::pass(std::size_t i, SystemState& state,
                                          std::vector<Event>& events) {
  Switch& s = switches_[i];
  const bool rises = !s.is_up;
  const double rate = evaluate(s, state).rate;
  Change change;
  set(s, rises, state);
  if (s.transmission >= 0) {
    const Transmission& transmission =
        model_.transmissions[index(s.transmission)];
    const joints::EventKind kind =
        joints::find_event(transmission.laws[s.law], rises);
    events.push_back({state.t, transmission.name,
                      std::string(joints::to_string(kind)), rate});
    change.has_jump = joints::may_jump(kind);
    return change;
  }
  const Coupler& coupler = model_.couplers[index(s.coupler)];
  joints::CouplerMemory& memory = state.memory[index(s.coupler)];
  const auto kind = joints::find_event(coupler.law, s.index, rises, memory);
  if (!kind) return change;
  events.push_back(
      {state.t, coupler.name, std::string(joints::to_string(*kind)), rate});
  change.has_jump = joints::may_jump(*kind);
  change.coupler = s.coupler;
  const joints::RelativeMotion motion =
      find_relative_motion(model_, state, s.coupler);
  const EvaluationTime now = now_of(state);
  change.energy_lost =
      joints::evaluate(coupler.law, motion, memory, now).energy;
  joints::update_memory(coupler.law, s.index, motion, memory);
  change.energy_lost -=
      joints::evaluate(coupler.law, motion, memory, now).energy;
  // The next event of a latch, for example, uses the same switch. That of
  // another latch, at the same time, is still to come.
  if (is_trigger(s)) s.is_up = evaluate(s, state).value >= 0.0;
  return change;
}

void EventObserver::exchange_memory(Archive& archive) {
  for (Switch& s : switches_) {
    archive(s.is_up, s.last.value, s.last.rate);
  }
}

void EventObserver::accept() {
  for (Switch& s : switches_) s.last = s.now;
}

void EventObserver::accept(const SystemState& state) {
  for (Switch& s : switches_) s.last = evaluate(s, state);
}

}  // namespace limber::dynamics
