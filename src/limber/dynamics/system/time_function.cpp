// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/system/time_function.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "limber/common/errors.hpp"
#include "limber/common/overloaded.hpp"

namespace limber::dynamics {
namespace {

// Whether t is at or past `edge`, for the given side of a jump.
bool has_passed(double t, double edge, Side side) {
  return side == Side::right ? t >= edge : t > edge;
}

bool is_on(double t, double from, double until, Side side) {
  return has_passed(t, from, side) && !has_passed(t, until, side);
}

double evaluate_pulse(const Pulse& pulse, double t, Side side) {
  if (!is_on(t, pulse.start, pulse.start + pulse.duration, side)) return 0.0;
  const double phase = (t - pulse.start) / pulse.duration;
  switch (pulse.shape) {
    case PulseShape::half_sine:
      return std::sin(std::numbers::pi * phase);
    case PulseShape::triangular:
      return 1.0 - std::abs(2.0 * phase - 1.0);
    case PulseShape::rectangular:
      break;
  }
  return 1.0;
}

double evaluate_steps(const StepSequence& steps, double t, Side side) {
  const std::ptrdiff_t i = find_interval(steps.times, t, side);
  return i < 0 ? 0.0 : steps.values[static_cast<std::size_t>(i)];
}

double evaluate_table(const Table& table, double t, Side side) {
  if (!is_on(t, table.times.front(), table.times.back(), side)) return 0.0;
  const auto i = static_cast<std::size_t>(find_interval(table.times, t, side));
  const double fraction =
      (t - table.times[i]) / (table.times[i + 1] - table.times[i]);
  return (1.0 - fraction) * table.values[i] + fraction * table.values[i + 1];
}

double evaluate_harmonics(const HarmonicSum& sum, double t, Side side) {
  if (!is_on(t, sum.from, sum.until, side)) return 0.0;
  double value = sum.mean;
  for (const Harmonic& h : sum.terms) {
    const double angle = h.omega * (t - sum.from);
    value += h.cosine * std::cos(angle) + h.sine * std::sin(angle);
  }
  return value;
}

void check_series(const std::vector<double>& times,
                  const std::vector<double>& values, std::size_t least,
                  const char* kind) {
  if (times.size() != values.size()) {
    throw InputError(fmt::format("{}: {} times but {} values", kind,
                                 times.size(), values.size()));
  }
  if (times.size() < least) {
    throw InputError(fmt::format("{}: expected at least {} points, got {}",
                                 kind, least, times.size()));
  }
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (!std::isfinite(times[i]) || !std::isfinite(values[i])) {
      throw InputError(fmt::format("{}: point {} is not finite", kind, i));
    }
    if (i > 0 && times[i] <= times[i - 1]) {
      throw InputError(
          fmt::format("{}: times must increase, but point {} is at {:g} s "
                      "after {:g} s",
                      kind, i, times[i], times[i - 1]));
    }
  }
}

void check_window(double from, double until, const char* kind) {
  if (!(until > from)) {
    throw InputError(
        fmt::format("{}: ends at {:g} s, not after {:g} s", kind, until, from));
  }
}

void check_harmonics(const HarmonicSum& sum) {
  check_window(sum.from, sum.until, "sum of sinusoids");
  bool is_finite = std::isfinite(sum.mean);
  for (const Harmonic& h : sum.terms) {
    is_finite = is_finite && std::isfinite(h.cosine) && std::isfinite(h.sine);
    if (h.omega >= 0.0 && std::isfinite(h.omega)) continue;
    throw InputError(fmt::format(
        "sum of sinusoids: an angular frequency is {:g} rad/s; expected >= 0",
        h.omega));
  }
  if (!is_finite) {
    throw InputError("sum of sinusoids: an amplitude is not finite");
  }
}

}  // namespace

std::ptrdiff_t find_interval(const std::vector<double>& times, double t,
                             Side side) {
  const auto past = side == Side::right
                        ? std::upper_bound(times.begin(), times.end(), t)
                        : std::lower_bound(times.begin(), times.end(), t);
  return past - times.begin() - 1;
}

void check(const TimeFunction& function) {
  std::visit(
      Overloaded{
          [](const Constant& c) { check_window(c.from, c.until, "constant"); },
          [](const StepSequence& s) {
            check_series(s.times, s.values, 1, "step sequence");
          },
          [](const Pulse& p) {
            if (!(p.duration > 0.0) || !std::isfinite(p.duration) ||
                !std::isfinite(p.start)) {
              throw InputError(fmt::format(
                  "pulse: duration is {:g} s; expected > 0", p.duration));
            }
          },
          [](const Sinusoid& s) {
            check_window(s.from, s.until, "sinusoid");
            if (!(s.frequency >= 0.0) || !std::isfinite(s.phase)) {
              throw InputError(
                  fmt::format("sinusoid: frequency is {:g} Hz; expected >= 0",
                              s.frequency));
            }
          },
          [](const HarmonicSum& s) { check_harmonics(s); },
          [](const Table& t) { check_series(t.times, t.values, 2, "table"); },
          [](const InputFunction& f) {
            LIMBER_EXPECT(f.input >= 0);
            if (!std::isfinite(f.factor)) {
              throw InputError("input: its factor is not finite");
            }
          },
      },
      function);
}

double evaluate(const TimeFunction& function, double t, Side side) {
  return evaluate(function, EvaluationTime{t, side});
}

double evaluate(const TimeFunction& function, const EvaluationTime& now) {
  const double t = now.t;
  const Side side = now.side;
  return std::visit(
      Overloaded{
          [&](const Constant& c) {
            return is_on(t, c.from, c.until, side) ? 1.0 : 0.0;
          },
          [&](const StepSequence& s) { return evaluate_steps(s, t, side); },
          [&](const Pulse& p) { return evaluate_pulse(p, t, side); },
          [&](const Sinusoid& s) {
            if (!is_on(t, s.from, s.until, side)) return 0.0;
            return std::sin(
                2.0 * std::numbers::pi * s.frequency * (t - s.from) + s.phase);
          },
          [&](const HarmonicSum& s) { return evaluate_harmonics(s, t, side); },
          [&](const Table& table) { return evaluate_table(table, t, side); },
          [&](const InputFunction& f) {
            return f.factor * find_input(now, f.input).value;
          },
      },
      function);
}

std::vector<double> break_times(const TimeFunction& function) {
  return std::visit(
      Overloaded{
          [](const Constant& c) {
            return std::vector{c.from, c.until};
          },
          [](const StepSequence& s) { return s.times; },
          [](const Pulse& p) {
            const double end = p.start + p.duration;
            if (p.shape != PulseShape::triangular) {
              return std::vector{p.start, end};
            }
            return std::vector{p.start, p.start + 0.5 * p.duration, end};
          },
          [](const Sinusoid& s) {
            return std::vector{s.from, s.until};
          },
          [](const HarmonicSum& s) {
            return std::vector{s.from, s.until};
          },
          [](const Table& t) { return t.times; },
          [](const InputFunction&) { return std::vector<double>{}; },
      },
      function);
}

}  // namespace limber::dynamics
