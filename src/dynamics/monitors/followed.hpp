// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "common/archive.hpp"
#include "dynamics/system_state.hpp"

namespace limber::dynamics {

/// A scalar's value of largest magnitude, with its sign, and when it was.
struct Extreme {
  double value = 0.0;
  double time = 0.0;  ///< [s]

  void include(double v, double t) {
    if (std::abs(v) > std::abs(value)) *this = {v, t};
  }
  bool operator==(const Extreme&) const = default;
};

/// How a followed scalar is known between the ends of steps.
enum class Course {
  motion,  ///< from the state, which the integrator's interpolation has
  values,  ///< from its own values: a stiff coupler makes large forces of the
           ///< small error of an interpolated state
};

/// Whoever sees a run's states in the order of time: the start, the ends of all
/// steps, twice where a coupler switches (before and after), and looks within
/// steps that are long for what moves.
struct Spectator {
  std::function<void()> begin;  ///< a run begins, or begins anew
  std::function<void(const SystemState&)> include;
  std::function<void(Archive&)> exchange_memory;  ///< for checkpoints
};

/// Scalars that a run follows at every step, as the columns of its probes.
struct Followed {
  /// Writes a value for each scalar, NaN where it has none. Allocates nothing
  /// once it was called.
  using Evaluate =
      std::function<void(const SystemState&, std::vector<double>&)>;
  std::vector<Course> courses = {};  ///< one a scalar
  Evaluate evaluate = {};
  /// Between two looks, at most: of what is faster than the steps [s].
  double longest = std::numeric_limits<double>::infinity();
  std::optional<Spectator> spectator = {};

  [[nodiscard]] bool is_empty() const { return courses.empty() && !spectator; }
};

}  // namespace limber::dynamics
