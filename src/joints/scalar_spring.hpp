// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "joints/scalar_motion.hpp"
#include "joints/spring_curve.hpp"

namespace limber::joints {

/// Spring and damper along a coordinate.
///
/// Equation   force = -(f(s) + c rate), s = z - rest; dissipation c rate^2.
///            Tension-only: force = -max(0, f(s) + c rate) for s > 0, else 0;
///            what the spring gives back faster than the line moves is
///            dissipated.
/// Limits     tension-only with damping, the force jumps by c rate where the
///            line becomes taut or slack.
class ScalarSpring {
 public:
  struct Parameters {
    SpringCurve curve = {};
    double damping = 0.0;       ///< c >= 0 [N s/m or N m s/rad]
    double rest = 0.0;          ///< [m or rad]
    bool tension_only = false;  ///< f(0) >= 0 then
  };

  /// @throws InputError for a value outside its range.
  explicit ScalarSpring(const Parameters& parameters);

  [[nodiscard]] const Parameters& parameters() const { return parameters_; }
  [[nodiscard]] ScalarResponse evaluate(const ScalarMotion& motion,
                                        const SwitchModes& modes = {}) const;

  /// Positive while a line is taut.
  [[nodiscard]] int switch_count() const {
    return parameters_.tension_only ? 1 : 0;
  }
  [[nodiscard]] SwitchValue find_switch(int index,
                                        const ScalarMotion& motion) const;

 private:
  Parameters parameters_;
};

}  // namespace limber::joints
