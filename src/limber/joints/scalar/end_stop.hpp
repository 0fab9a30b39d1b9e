// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <optional>

#include "limber/joints/scalar/scalar_law_kind.hpp"

namespace limber::joints {

/// One-sided stops at one or both ends of a coordinate's range.
///
/// Equation   beyond a bound by d > 0: k d max(0, 1 + b d') back into the
///            range; energy k d^2 / 2; dissipation k b d d'^2, or -k d d' where
///            the body leaves faster than the stop can follow
/// Source     [@hunt1975], exponent 1: no force at first contact, never tension
class EndStop : public WithoutCommand {
 public:
  /// No stop at this end [m or rad].
  static constexpr double kUnbounded = std::numeric_limits<double>::infinity();
  struct Parameters {
    double lower = -kUnbounded;  ///< [m or rad]
    double upper = kUnbounded;   ///< [m or rad]
    double stiffness = 0.0;      ///< k > 0 [N/m or N m/rad]
    double damping = 0.0;        ///< b >= 0 [s/m or s/rad]
  };

  /// @throws InputError if no z is within the bounds or a value is outside its
  /// range.
  explicit EndStop(const Parameters& parameters);

  [[nodiscard]] const Parameters& parameters() const { return parameters_; }
  [[nodiscard]] ScalarResponse evaluate(const ScalarMotion& motion,
                                        const SwitchModes& modes = {}) const;
  [[nodiscard]] ScalarResponse evaluate(const ScalarMotion& motion,
                                        const EvaluationTime& /*now*/,
                                        const SwitchModes& modes) const {
    return evaluate(motion, modes);
  }
  [[nodiscard]] ScalarResponse evaluate_over_step(
      const CoordinateStep& coordinate, const StepTimes& times,
      const SwitchModes& modes) const;

  /// Positive during contact with the upper stop (0) or the lower stop (1);
  /// -infinity for a stop that does not exist.
  [[nodiscard]] static int switch_count() { return 2; }
  [[nodiscard]] SwitchValue find_switch(int index,
                                        const ScalarMotion& motion) const;
  [[nodiscard]] static EventKind find_event(bool rises) {
    return rises ? EventKind::stop_reached : EventKind::stop_left;
  }

  [[nodiscard]] std::optional<BeyondBound> find_beyond_bound(
      const ScalarMotion& motion) const;

 private:
  Parameters parameters_;
};

/// The damping b [s/m or s/rad] with which a free body that arrives at `speed`
/// leaves at `restitution` times that speed.
///
/// Equation   (1 + e) beta = ln((1 + beta) / (1 - e beta)), beta = b v:
///            the first integral of m d'' = -k d (1 + b d'), for any m and k
/// @param restitution e in (0, 1] [-]
/// @param speed v > 0 [m/s or rad/s]
/// @throws InputError for values outside their range.
[[nodiscard]] double find_stop_damping(double restitution, double speed);

constexpr auto fields_of(const EndStop::Parameters*) {
  return list_fields("stop", "lower [m, rad]", "upper [m, rad]",
                     "stiffness [N/m, N m/rad]", "damping [s/m, s/rad]");
}

}  // namespace limber::joints
