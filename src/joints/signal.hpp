// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <variant>
#include <vector>

#include "common/instant.hpp"

/// What drives follow: a value and its rate at every time. In the unit of what
/// is driven: rad, m, rad/s, N m, ...
namespace limber::joints {

struct ConstantSignal {
  double value = 0.0;
};

/// How a ramp gets from one value to the other.
enum class RampShape {
  linear,     ///< constant rate
  trapezoid,  ///< the rate rises, holds and falls, linearly
  smooth,     ///< 10 s^3 - 15 s^4 + 6 s^5: rate and its rate start and end at 0
};
struct RampSignal {
  double from = 0.0;
  double to = 0.0;
  double start = 0.0;     ///< [s]
  double duration = 0.0;  ///< > 0 [s]
  RampShape shape = RampShape::linear;
  /// Of a trapezoid: how much of the duration the rate rises, and how much it
  /// falls; in (0, 1/2] [-].
  double rise = 0.25;
};

/// Linear between points, the first and the last value held outside them.
struct TableSignal {
  std::vector<double> times;  ///< increasing [s]
  std::vector<double> values;
};

/// mean + amplitude sin(2 pi frequency (t - start) + phase) from `start` on,
/// before it the value at `start`.
struct SineSignal {
  double mean = 0.0;
  double amplitude = 0.0;
  double frequency = 0.0;  ///< [Hz]
  double phase = 0.0;      ///< [rad]
  double start = 0.0;      ///< [s]
};

/// A share of a command, later.
struct Impulse {
  double share = 1.0;  ///< of all of them together 1 [-]
  double delay = 0.0;  ///< >= 0 [s]
};

/// Equation   s(t) = sum_i share_i base(t - delay_i)
struct Signal {
  std::variant<ConstantSignal, RampSignal, TableSignal, SineSignal> base;
  std::vector<Impulse> shaper = {{}};
};

struct SignalValue {
  double value = 0.0;
  double rate = 0.0;  ///< per second
};

/// A time within round-off of a break counts by its side.
[[nodiscard]] SignalValue evaluate(const Signal& signal, const Instant& now);

/// Times at which the value or a derivative of it jumps, increasing and further
/// apart than round-off [s].
[[nodiscard]] std::vector<double> break_times(const Signal& signal);

/// Bounds on the magnitude of the value and of the rate over all time: reached
/// without a shaper; with one, the base's times the sum of |share|.
[[nodiscard]] SignalValue find_largest(const Signal& signal);

/// @throws InputError for a value that is not finite, a duration or frequency
/// <= 0, a rise outside (0, 1/2], a table that is empty or whose times do not
/// increase, shares that do not sum to one, a negative delay.
void check(const Signal& signal);

/// How robust a shaper is against a wrong frequency.
enum class ShaperKind {
  zv,   ///< two impulses: zero vibration
  zvd,  ///< three: its derivative by frequency, too
};

/// Impulses after which a command leaves no vibration of a mode.
///
/// Equation   K = exp(-zeta pi / sqrt(1 - zeta^2)), spaced by half of the
///            damped period; shares (1, K) / (1 + K) or
///            (1, 2 K, K^2) / (1 + K)^2
/// Source     [@singer1990]
/// @param frequency undamped natural frequency > 0 [Hz]
/// @param ratio damping ratio in [0, 1) [-]
/// @throws InputError for values outside their range.
[[nodiscard]] std::vector<Impulse> make_shaper(ShaperKind kind,
                                               double frequency, double ratio);

}  // namespace limber::joints
