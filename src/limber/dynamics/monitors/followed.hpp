// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "limber/common/records/archive.hpp"
#include "limber/dynamics/system/system_state.hpp"

namespace limber::dynamics {

/// A scalar's value of largest magnitude, signed, and its time.
struct Extreme {
  double value = 0.0;  ///< [unit of the scalar]
  double time = 0.0;   ///< [s]

  /// @returns whether it is the largest so far, by more than round-off: the
  ///          extreme of a constant is at its first time
  bool include(double v, double t) {
    constexpr double kRoundOff = 1e-11;  // of a long run, relative
    if (!(std::abs(v) > (1.0 + kRoundOff) * std::abs(value))) return false;
    *this = {v, t};
    return true;
  }
  bool operator==(const Extreme&) const = default;
};

inline void exchange(Archive& archive, Extreme& extreme) {
  archive(extreme.value, extreme.time);
}

/// How a recorded scalar is evaluated within steps.
enum class Course {
  motion,  ///< from the integrator's interpolated state
  values,  ///< from its values at steps: a stiff coupler amplifies the small
           ///< error of an interpolated state
};

/// Observer of a run's states in order of time: the start, the ends of all
/// steps (before and after an event of a coupler), and states within steps that
/// are long for the motion.
struct MotionObserver {
  std::function<void()> begin;  ///< a run begins or restarts
  std::function<void(const SystemState&)> include;
  std::function<void(Archive&)> exchange_memory;  ///< for checkpoints
};

/// Scalars that a run evaluates at every step, such as the columns of its
/// probes.
struct Followed {
  /// Writes a value for each scalar, NaN if undefined. Allocates only in the
  /// first call.
  using Evaluate =
      std::function<void(const SystemState&, std::vector<double>&)>;
  std::vector<Course> courses = {};  ///< one per scalar
  Evaluate evaluate = {};
  /// The place of a scalar's value in the last evaluation, as a number defined
  /// by its owner, -1 for none; may be empty.
  std::function<int(std::size_t scalar)> find_place = {};
  /// Largest time between evaluations, for motion faster than the steps [s].
  double longest = std::numeric_limits<double>::infinity();
  std::optional<MotionObserver> motion_observer = {};

  [[nodiscard]] bool is_empty() const {
    return courses.empty() && !motion_observer;
  }
};

}  // namespace limber::dynamics
