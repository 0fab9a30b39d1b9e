// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

namespace limber {

/// Selects a one-sided limit at a discontinuity in time.
enum class Side { left, right };

/// An input of a system as a function of time: a straight line since its last
/// jump, and the line before that.
///
/// Equation   value(t) = value + rate (t - since) from `since` on,
///            value_before + rate_before (t - since) before it
struct InputState {
  double since = 0.0;         ///< [s]
  double value = 0.0;         ///< [unit of the input]
  double rate = 0.0;          ///< [unit of the input per second]
  double value_before = 0.0;  ///< limit from the left at `since` [same unit]
  double rate_before = 0.0;   ///< [unit of the input per second]
};

/// A time, the side from which functions are evaluated at jumps, and the inputs
/// that they may follow.
struct EvaluationTime {
  double t = 0.0;  ///< [s]
  Side side = Side::right;
  std::span<const InputState> inputs = {};  ///< those of the system's state
};

/// An input at a time, and its rate.
struct InputValue {
  double value = 0.0;  ///< [unit of the input]
  double rate = 0.0;   ///< [unit of the input per second]
};

/// @param input index into now.inputs
/// @throws ContractError if there is no such input: a function that follows one
/// has no value without a state.
[[nodiscard]] InputValue find_input(const EvaluationTime& now, int input);

}  // namespace limber
