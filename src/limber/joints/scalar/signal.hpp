// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "limber/common/evaluation_time.hpp"
#include "limber/common/records/fields.hpp"

/// Commands of drives: a value and its rate at every time, in the unit of the
/// commanded quantity: rad, m, rad/s, N m, ...
namespace limber::joints {

struct ConstantSignal {
  double value = 0.0;  ///< [unit of the command]
};

/// Shape of a ramp from one value to another.
enum class RampShape {
  linear,     ///< constant rate
  trapezoid,  ///< the rate rises linearly, is constant, falls linearly
  smooth,     ///< 10 s^3 - 15 s^4 + 6 s^5: first two derivatives 0 at the ends
};
struct RampSignal {
  double from = 0.0;      ///< [unit of the command]
  double to = 0.0;        ///< [unit of the command]
  double start = 0.0;     ///< [s]
  double duration = 0.0;  ///< > 0 [s]
  RampShape shape = RampShape::linear;
  /// Of a trapezoid: fraction of the duration in which the rate rises, and in
  /// which it falls; in (0, 1/2] [-].
  double rise = 0.25;
};

/// Linear between points; the first and the last value outside them.
struct TableSignal {
  std::vector<double> times;   ///< increasing [s]
  std::vector<double> values;  ///< [unit of the command]
};

/// mean + amplitude sin(2 pi frequency (t - start) + phase) from `start` on;
/// before, the value at `start`.
struct SineSignal {
  double mean = 0.0;       ///< [unit of the command]
  double amplitude = 0.0;  ///< [unit of the command]
  double frequency = 0.0;  ///< [Hz]
  double phase = 0.0;      ///< [rad]
  double start = 0.0;      ///< [s]
};

/// factor times an input of the system, which a controller writes: held, or
/// linear between its samples. Without a state it has no value.
struct InputSignal {
  int input = 0;        ///< index of the system's input
  double factor = 1.0;  ///< [unit of the driven quantity / unit of the input]
};

/// One impulse of an input shaper: a fraction of the command, delayed.
struct Impulse {
  double fraction = 1.0;  ///< fraction; those of a shaper sum to 1 [-]
  double delay = 0.0;     ///< >= 0 [s]
};

/// A command, shaped.
///
/// Equation   s(t) = sum_i share_i base(t - delay_i)
struct Signal {
  std::variant<ConstantSignal, RampSignal, TableSignal, SineSignal, InputSignal>
      base;
  std::vector<Impulse> shaper = {{}};
};

struct SignalValue {
  double value = 0.0;  ///< [unit of the command]
  double rate = 0.0;   ///< [unit of the command per second]
};

/// Value and rate of a signal. At a time within round-off of a break,
/// `now.side` selects the limit.
/// @throws ContractError for an input that `now` does not have.
[[nodiscard]] SignalValue evaluate(const Signal& signal,
                                   const EvaluationTime& now);

/// Integral of the value from a fixed time, in closed form: differences are the
/// travel of a command of rates [unit of the command s]. Of an input, which is
/// known at its samples only: nothing.
[[nodiscard]] std::optional<double> integrate(const Signal& signal, double t);

/// Times at which the value or one of its derivatives jumps, increasing and
/// further apart than round-off [s]; none of an input, which jumps when its
/// controller is sampled.
[[nodiscard]] std::vector<double> break_times(const Signal& signal);

/// Indices of the inputs that it follows.
[[nodiscard]] std::vector<int> find_inputs(const Signal& signal);

/// Bounds on the magnitudes of value and rate over all time: the maxima without
/// a shaper; with one, those of the base times the sum of |fraction|. Infinite
/// for an input, which is not known in advance.
[[nodiscard]] SignalValue find_largest(const Signal& signal);

/// @throws InputError for a value that is not finite, a duration or frequency
/// <= 0, a rise outside (0, 1/2], a table that is empty or whose times do not
/// increase, fractions that do not sum to one, a negative delay, a shaper of an
/// input.
void check(const Signal& signal);

/// Robustness of a shaper to an error in frequency.
enum class ShaperKind {
  zv,   ///< two impulses: zero vibration
  zvd,  ///< three: also zero derivative with respect to frequency
};

/// Impulses of a shaper that leaves no residual vibration of a mode.
///
/// Equation   K = exp(-zeta pi / sqrt(1 - zeta^2)), spaced by half of the
///            damped period; fractions (1, K) / (1 + K) or
///            (1, 2 K, K^2) / (1 + K)^2
/// Source     [@singer1990]
/// @param frequency undamped natural frequency > 0 [Hz]
/// @param ratio damping ratio in [0, 1) [-]
/// @throws InputError for values outside their range.
[[nodiscard]] std::vector<Impulse> make_shaper(ShaperKind kind,
                                               double frequency, double ratio);

constexpr auto fields_of(const ConstantSignal*) {
  return list_fields("constant", "value");
}

constexpr auto fields_of(const RampSignal*) {
  return list_fields("ramp", "from", "to", "start [s]", "duration [s]", "shape",
                     "rise");
}

constexpr auto fields_of(const TableSignal*) {
  return list_fields("table", "times [s]", "values");
}

constexpr auto fields_of(const SineSignal*) {
  return list_fields("sine", "mean", "amplitude", "frequency [Hz]",
                     "phase [rad]", "start [s]");
}

constexpr auto fields_of(const InputSignal*) {
  return list_fields("input", "index", "factor");
}

constexpr auto fields_of(const Impulse*) {
  return list_fields("shaper's impulse", "share", "delay [s]");
}

constexpr auto fields_of(const Signal*) {
  return list_fields("signal", "base", "shaper");
}

}  // namespace limber::joints
