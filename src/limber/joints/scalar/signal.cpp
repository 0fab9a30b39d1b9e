// SPDX-License-Identifier: BSD-3-Clause
#include "limber/joints/scalar/signal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "limber/common/errors.hpp"
#include "limber/common/overloaded.hpp"

namespace limber::joints {
namespace {

constexpr double kPi = std::numbers::pi;

// Round-off of a time that is the sum of another and a delay [s].
double find_roundoff(double time, double delay) {
  constexpr double kRoundoff = 8.0 * std::numeric_limits<double>::epsilon();
  return kRoundoff * std::max(std::abs(time), delay);
}

// Whether `now` is after `time`, delayed; at that time, its side decides.
bool is_past(const EvaluationTime& now, double time, double delay) {
  const double late = now.t - (time + delay);
  const bool is_there = std::abs(late) <= find_roundoff(time, delay);
  return is_there ? now.side == Side::right : late > 0.0;
}

// Progress from 0 to 1 and its rate, at the fraction `s` of the duration.
SignalValue find_progress(const RampSignal& ramp, double s) {
  switch (ramp.shape) {
    case RampShape::smooth:
      return {s * s * s * (10.0 + s * (-15.0 + 6.0 * s)),
              30.0 * s * s * (1.0 - s) * (1.0 - s)};
    case RampShape::trapezoid: {
      const double a = ramp.rise;
      const double top = 1.0 / (1.0 - a);
      if (s < a) return {0.5 * top * s * s / a, top * s / a};
      if (s <= 1.0 - a) return {top * (s - 0.5 * a), top};
      const double left = 1.0 - s;
      return {1.0 - 0.5 * top * left * left / a, top * left / a};
    }
    case RampShape::linear:
      break;
  }
  return {s, 1.0};
}

// Shifts all times of a signal by `delay` [s].
SignalValue evaluate_base(const ConstantSignal& signal,
                          const EvaluationTime& /*now*/, double /*delay*/) {
  return {signal.value, 0.0};
}

SignalValue evaluate_base(const RampSignal& ramp, const EvaluationTime& now,
                          double delay) {
  if (!is_past(now, ramp.start, delay)) return {ramp.from, 0.0};
  if (is_past(now, ramp.start + ramp.duration, delay)) return {ramp.to, 0.0};
  const double height = ramp.to - ramp.from;
  const double fraction = (now.t - delay - ramp.start) / ramp.duration;
  const SignalValue progress =
      find_progress(ramp, std::clamp(fraction, 0.0, 1.0));
  return {ramp.from + height * progress.value,
          height * progress.rate / ramp.duration};
}

SignalValue evaluate_base(const TableSignal& table, const EvaluationTime& now,
                          double delay) {
  const auto& times = table.times;
  const auto next = std::partition_point(
      times.begin(), times.end(),
      [&](double time) { return is_past(now, time, delay); });
  if (next == times.begin()) return {table.values.front(), 0.0};
  if (next == times.end()) return {table.values.back(), 0.0};
  const auto i = static_cast<std::size_t>(next - times.begin());
  const double slope =
      (table.values[i] - table.values[i - 1]) / (times[i] - times[i - 1]);
  return {table.values[i - 1] + slope * (now.t - delay - times[i - 1]), slope};
}

SignalValue evaluate_base(const SineSignal& sine, const EvaluationTime& now,
                          double delay) {
  const double omega = 2.0 * kPi * sine.frequency;
  const bool runs = is_past(now, sine.start, delay);
  const double angle =
      (runs ? omega * (now.t - delay - sine.start) : 0.0) + sine.phase;
  return {sine.mean + sine.amplitude * std::sin(angle),
          runs ? sine.amplitude * omega * std::cos(angle) : 0.0};
}

// Shapers do not delay inputs: check().
SignalValue evaluate_base(const InputSignal& signal, const EvaluationTime& now,
                          double /*delay*/) {
  const InputValue input = find_input(now, signal.input);
  return {signal.factor * input.value, signal.factor * input.rate};
}

// Integral of a ramp's progress over the fraction `s` of the duration.
double integrate_progress(const RampSignal& ramp, double s) {
  switch (ramp.shape) {
    case RampShape::smooth:
      return s * s * s * s * (2.5 + s * (-3.0 + s));
    case RampShape::trapezoid: {
      const double a = ramp.rise;
      const double top = 1.0 / (1.0 - a);
      if (s < a) return top * s * s * s / (6.0 * a);
      if (s <= 1.0 - a) {
        return top * (a * a / 6.0 + 0.5 * s * (s - a));
      }
      const double left = 1.0 - s;
      return 0.5 - left + top * left * left * left / (6.0 * a);
    }
    case RampShape::linear:
      break;
  }
  return 0.5 * s * s;
}

double integrate_base(const ConstantSignal& signal, double t) {
  return signal.value * t;
}

double integrate_base(const RampSignal& ramp, double t) {
  const double s = (t - ramp.start) / ramp.duration;
  if (s <= 0.0) return ramp.from * (t - ramp.start);
  if (s >= 1.0) {
    return ramp.duration * (0.5 * (ramp.from + ramp.to) + ramp.to * (s - 1.0));
  }
  return ramp.duration *
         (ramp.from * s + (ramp.to - ramp.from) * integrate_progress(ramp, s));
}

double integrate_base(const TableSignal& table, double t) {
  const auto& times = table.times;
  const auto& values = table.values;
  if (t <= times.front()) return values.front() * (t - times.front());
  double sum = 0.0;
  for (std::size_t i = 1; i < times.size(); ++i) {
    const double span = times[i] - times[i - 1];
    const double fraction = std::min((t - times[i - 1]) / span, 1.0);
    const double rise = values[i] - values[i - 1];
    sum += span * fraction * (values[i - 1] + 0.5 * fraction * rise);
    if (fraction < 1.0) return sum;
  }
  return sum + values.back() * (t - times.back());
}

double integrate_base(const SineSignal& sine, double t) {
  const double omega = 2.0 * kPi * sine.frequency;
  const double since = t - sine.start;
  if (since <= 0.0) {
    return (sine.mean + sine.amplitude * std::sin(sine.phase)) * since;
  }
  return sine.mean * since -
         sine.amplitude / omega *
             (std::cos(omega * since + sine.phase) - std::cos(sine.phase));
}

std::vector<double> base_breaks(const Signal& signal) {
  return std::visit(
      Overloaded{
          [](const ConstantSignal&) { return std::vector<double>{}; },
          [](const RampSignal& r) {
            const double end = r.start + r.duration;
            if (r.shape != RampShape::trapezoid) {
              return std::vector<double>{r.start, end};
            }
            const double rise = r.rise * r.duration;
            return std::vector<double>{r.start, r.start + rise, end - rise,
                                       end};
          },
          [](const TableSignal& table) { return table.times; },
          [](const SineSignal& s) { return std::vector<double>{s.start}; },
          [](const InputSignal&) { return std::vector<double>{}; }},
      signal.base);
}

SignalValue base_largest(const Signal& signal) {
  return std::visit(
      Overloaded{
          [](const ConstantSignal& c) {
            return SignalValue{std::abs(c.value), 0.0};
          },
          [](const RampSignal& r) {
            const double steepest = r.shape == RampShape::smooth ? 1.875
                                    : r.shape == RampShape::trapezoid
                                        ? 1.0 / (1.0 - r.rise)
                                        : 1.0;
            return SignalValue{std::max(std::abs(r.from), std::abs(r.to)),
                               steepest * std::abs(r.to - r.from) / r.duration};
          },
          [](const TableSignal& t) {
            SignalValue largest;
            for (std::size_t i = 0; i < t.times.size(); ++i) {
              largest.value = std::max(largest.value, std::abs(t.values[i]));
              if (i == 0) continue;
              largest.rate = std::max(largest.rate,
                                      std::abs((t.values[i] - t.values[i - 1]) /
                                               (t.times[i] - t.times[i - 1])));
            }
            return largest;
          },
          [](const SineSignal& s) {
            return SignalValue{std::abs(s.mean) + std::abs(s.amplitude),
                               2.0 * kPi * s.frequency * std::abs(s.amplitude)};
          },
          [](const InputSignal&) {
            constexpr double kUnknown = std::numeric_limits<double>::infinity();
            return SignalValue{kUnknown, kUnknown};
          }},
      signal.base);
}

void require_of_signal(bool holds, const std::string& text) {
  if (!holds) throw InputError("signal: " + text);
}

void require_finite(std::initializer_list<double> values) {
  for (const double value : values) {
    require_of_signal(std::isfinite(value), "a value is not finite");
  }
}

void check_base(const ConstantSignal& c) { require_finite({c.value}); }

void check_base(const RampSignal& r) {
  require_finite({r.from, r.to, r.start, r.duration});
  require_of_signal(
      r.duration > 0.0,
      fmt::format("a ramp's duration is {:g} s; expected > 0", r.duration));
  require_of_signal(
      r.rise > 0.0 && r.rise <= 0.5,
      fmt::format("a trapezoid's rise is {:g} of its duration; expected "
                  "more than 0, at most 0.5",
                  r.rise));
}

void check_base(const TableSignal& t) {
  require_of_signal(
      !t.times.empty() && t.times.size() == t.values.size(),
      fmt::format("a table has {} times and {} values; expected as many, "
                  "at least one",
                  t.times.size(), t.values.size()));
  for (std::size_t i = 0; i < t.times.size(); ++i) {
    require_finite({t.times[i], t.values[i]});
    require_of_signal(
        i == 0 || t.times[i] > t.times[i - 1],
        fmt::format("a table's times do not increase at {:g} s", t.times[i]));
  }
}

void check_base(const SineSignal& s) {
  require_finite({s.mean, s.amplitude, s.frequency, s.phase, s.start});
  require_of_signal(
      s.frequency > 0.0,
      fmt::format("a frequency is {:g} Hz; expected > 0", s.frequency));
}

void check_base(const InputSignal& s) {
  LIMBER_EXPECT(s.input >= 0);
  require_finite({s.factor});
}

}  // namespace

SignalValue evaluate(const Signal& signal, const EvaluationTime& now) {
  SignalValue sum;
  for (const Impulse& impulse : signal.shaper) {
    const SignalValue part = std::visit(
        [&](const auto& base) {
          return evaluate_base(base, now, impulse.delay);
        },
        signal.base);
    sum.value += impulse.fraction * part.value;
    sum.rate += impulse.fraction * part.rate;
  }
  return sum;
}

std::optional<double> integrate(const Signal& signal, double t) {
  if (std::holds_alternative<InputSignal>(signal.base)) return {};
  double sum = 0.0;
  for (const Impulse& impulse : signal.shaper) {
    std::visit(
        [&](const auto& base) {
          if constexpr (!std::is_same_v<std::decay_t<decltype(base)>,
                                        InputSignal>) {
            sum += impulse.fraction * integrate_base(base, t - impulse.delay);
          }
        },
        signal.base);
  }
  return sum;
}

std::vector<double> break_times(const Signal& signal) {
  std::vector<double> times;
  for (const double time : base_breaks(signal)) {
    for (const Impulse& impulse : signal.shaper) {
      times.push_back(time + impulse.delay);
    }
  }
  std::sort(times.begin(), times.end());
  double latest = 0.0;
  for (const Impulse& impulse : signal.shaper) {
    latest = std::max(latest, impulse.delay);
  }
  const auto is_same = [&](double a, double b) {
    return b - a <= find_roundoff(b, latest);
  };
  times.erase(std::unique(times.begin(), times.end(), is_same), times.end());
  return times;
}

std::vector<int> find_inputs(const Signal& signal) {
  const auto* input = std::get_if<InputSignal>(&signal.base);
  return input ? std::vector<int>{input->input} : std::vector<int>{};
}

SignalValue find_largest(const Signal& signal) {
  double fractions = 0.0;
  for (const Impulse& impulse : signal.shaper) {
    fractions += std::abs(impulse.fraction);
  }
  const SignalValue base = base_largest(signal);
  return {fractions * base.value, fractions * base.rate};
}

void check(const Signal& signal) {
  std::visit([](const auto& base) { check_base(base); }, signal.base);
  constexpr double kRoundoff = 1e-12;
  double sum = 0.0;
  for (const Impulse& impulse : signal.shaper) {
    require_finite({impulse.fraction, impulse.delay});
    require_of_signal(impulse.delay >= 0.0,
                      fmt::format("a shaper's delay is {:g} s; expected >= 0",
                                  impulse.delay));
    sum += impulse.fraction;
  }
  require_of_signal(
      std::abs(sum - 1.0) < kRoundoff,
      fmt::format("a shaper's fractions sum to {:g}; expected 1", sum));
  require_of_signal(
      find_inputs(signal).empty() ||
          (signal.shaper.size() == 1 && signal.shaper[0].delay == 0.0),
      "it follows an input and has a shaper, which would need past values of "
      "the input; shape it in the controller that writes the input");
}

std::vector<Impulse> make_shaper(ShaperKind kind, double frequency,
                                 double ratio) {
  require_of_signal(
      frequency > 0.0 && std::isfinite(frequency),
      fmt::format("a shaper's frequency is {:g} Hz; expected > 0", frequency));
  require_of_signal(
      ratio >= 0.0 && ratio < 1.0,
      fmt::format("a shaper's damping ratio is {:g}; expected 0 to 1", ratio));
  const double damped = std::sqrt(1.0 - ratio * ratio);
  const double K = std::exp(-ratio * kPi / damped);
  const double half = 0.5 / (frequency * damped);
  if (kind == ShaperKind::zv) {
    return {{1.0 / (1.0 + K), 0.0}, {K / (1.0 + K), half}};
  }
  const double sum = (1.0 + K) * (1.0 + K);
  return {{1.0 / sum, 0.0}, {2.0 * K / sum, half}, {K * K / sum, 2.0 * half}};
}

}  // namespace limber::joints
