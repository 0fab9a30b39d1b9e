// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/joints/scalar/scalar_law_kind.hpp"
#include "limber/joints/scalar/spring_curve.hpp"

namespace limber::joints {

/// Spring and damper along a coordinate.
///
/// Equation   force = -(f(s) + c rate), s = z - rest; dissipation c rate^2.
///            Tension-only: force = -max(0, f(s) + c rate) for s > 0, else 0;
///            elastic energy released faster than the line can follow is
///            dissipated.
/// Limits     if tension-only with damping, the force jumps by c rate where the
///            line becomes taut or slack.
class ScalarSpring : public WithoutCommand, public WithoutBounds {
 public:
  struct Parameters {
    SpringCurve curve = {};
    double damping = 0.0;       ///< c >= 0 [N s/m or N m s/rad]
    double rest = 0.0;          ///< z at rest [m or rad]
    bool tension_only = false;  ///< f(0) >= 0 then
  };

  /// @throws InputError for a value outside its range.
  explicit ScalarSpring(const Parameters& parameters);

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

  /// Positive while a tension-only spring is taut.
  [[nodiscard]] int switch_count() const {
    return parameters_.tension_only ? 1 : 0;
  }
  [[nodiscard]] SwitchValue find_switch(int index,
                                        const ScalarMotion& motion) const;
  [[nodiscard]] static EventKind find_event(bool rises) {
    return rises ? EventKind::taut : EventKind::slack;
  }

 private:
  Parameters parameters_;
};

constexpr auto fields_of(const ScalarSpring::Parameters*) {
  return list_fields("spring", "", "damping [N s/m, N m s/rad]",
                     "rest [m, rad]", "tension only");
}

}  // namespace limber::joints
