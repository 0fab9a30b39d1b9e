// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <limits>
#include <variant>
#include <vector>

#include "limber/common/evaluation_time.hpp"

namespace limber::dynamics {

/// A time that is never reached [s].
inline constexpr double kNever = std::numeric_limits<double>::infinity();

/// Factor c(t) [-] of a load. `from`, `until` [s]; zero outside them.
struct Constant {
  double from = 0.0;      ///< [s]
  double until = kNever;  ///< [s]
};
/// values[i] on [times[i], times[i+1]); zero before, the last value from its
/// time on.
struct StepSequence {
  std::vector<double> times;   ///< [s]
  std::vector<double> values;  ///< [-]
};
enum class PulseShape { rectangular, half_sine, triangular };
struct Pulse {
  PulseShape shape = PulseShape::rectangular;
  double start = 0.0;     ///< [s]
  double duration = 0.0;  ///< > 0 [s]
};
/// sin(2 pi frequency (t - from) + phase), frequency [Hz], phase [rad].
struct Sinusoid {
  double frequency = 0.0;  ///< [Hz]
  double phase = 0.0;      ///< [rad]
  double from = 0.0;       ///< [s]
  double until = kNever;   ///< [s]
};
/// One term of a sum of sinusoids, angular frequency [rad/s].
struct Harmonic {
  double omega = 0.0;   ///< [rad/s]
  double cosine = 0.0;  ///< [-]
  double sine = 0.0;    ///< [-]
};
/// mean + sum of cosine cos(omega (t - from)) + sine sin(omega (t - from)).
struct HarmonicSum {
  double mean = 0.0;  ///< [-]
  std::vector<Harmonic> terms = {};
  double from = 0.0;      ///< [s]
  double until = kNever;  ///< [s]
};
/// Linear between points; zero outside them.
struct Table {
  std::vector<double> times;   ///< [s]
  std::vector<double> values;  ///< [-]
};

/// factor times an input of the system (SystemModel::inputs), which a
/// controller writes. Without a state it has no value.
struct InputFunction {
  int input = 0;        ///< index
  double factor = 1.0;  ///< [1 / unit of the input]
};

using TimeFunction = std::variant<Constant, StepSequence, Pulse, Sinusoid,
                                  HarmonicSum, Table, InputFunction>;

/// Index i of the interval [times[i], times[i+1]) that contains t, the last one
/// unbounded; -1 before the first.
[[nodiscard]] std::ptrdiff_t find_interval(const std::vector<double>& times,
                                           double t, Side side);

/// @throws InputError for non-increasing times, sizes that differ, a value
/// that is not finite, a pulse without duration.
/// @throws ContractError for a negative index of an input.
void check(const TimeFunction& function);

/// Value of the function [-].
/// @throws ContractError for an input that `now` does not have.
[[nodiscard]] double evaluate(const TimeFunction& function,
                              const EvaluationTime& now);
/// Value of a function that follows no input [-].
/// @param t time [s]
/// @param side limit at a discontinuity
/// @throws ContractError if it follows one.
[[nodiscard]] double evaluate(const TimeFunction& function, double t,
                              Side side);

/// Times at which the function or its slope jumps, increasing [s]; none of an
/// input: it jumps when its controller is sampled.
[[nodiscard]] std::vector<double> break_times(const TimeFunction& function);

}  // namespace limber::dynamics
