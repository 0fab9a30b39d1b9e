// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <limits>
#include <variant>
#include <vector>

#include "common/instant.hpp"

namespace limber::dynamics {

inline constexpr double kNever = std::numeric_limits<double>::infinity();

/// Factor c(t) [-] of a load. `from`, `until` [s]; zero outside them.
struct Constant {
  double from = 0.0;
  double until = kNever;
};
/// values[i] holds on [times[i], times[i+1]); zero before, last one held.
struct StepSequence {
  std::vector<double> times;
  std::vector<double> values;
};
enum class PulseShape { rectangular, half_sine, triangular };
struct Pulse {
  PulseShape shape = PulseShape::rectangular;
  double start = 0.0;
  double duration = 0.0;  ///< > 0 [s]
};
/// sin(2 pi frequency (t - from) + phase), frequency [Hz], phase [rad].
struct Sinusoid {
  double frequency = 0.0;
  double phase = 0.0;
  double from = 0.0;
  double until = kNever;
};
/// One term of a sum of sinusoids, angular frequency [rad/s].
struct Harmonic {
  double omega = 0.0;
  double cosine = 0.0;
  double sine = 0.0;
};
/// mean + sum of cosine cos(omega (t - from)) + sine sin(omega (t - from)).
struct HarmonicSum {
  double mean = 0.0;
  std::vector<Harmonic> terms = {};
  double from = 0.0;
  double until = kNever;
};
/// Linear between points; zero outside them.
struct Table {
  std::vector<double> times;
  std::vector<double> values;
};

using TimeFunction =
    std::variant<Constant, StepSequence, Pulse, Sinusoid, HarmonicSum, Table>;

/// Index i of the interval [times[i], times[i+1]) that holds t, the last one
/// open; -1 before the first.
[[nodiscard]] std::ptrdiff_t find_interval(const std::vector<double>& times,
                                           double t, Side side);

/// @throws InputError for non-increasing times, sizes that differ, a value
/// that is not finite, a pulse of no duration.
void check(const TimeFunction& function);

[[nodiscard]] double evaluate(const TimeFunction& function, double t,
                              Side side);

/// Times at which the function or its slope jumps, increasing [s].
[[nodiscard]] std::vector<double> break_times(const TimeFunction& function);

}  // namespace limber::dynamics
