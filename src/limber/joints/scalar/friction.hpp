// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/joints/scalar/scalar_law_kind.hpp"

namespace limber::joints {

/// Coulomb friction, regularised near zero speed, and viscous friction.
///
/// Equation   force = -Fc v / sqrt(v^2 + vs^2) - c v
/// Source     the square-root regularisation of [@wriggers2006, sec. 5.2]
/// Limits     does not stick: under a force F < Fc it creeps with
///            v = vs F / sqrt(Fc^2 - F^2). Where friction changes the speed by
///            more than vs in a step, Newton's method may not converge.
class Friction : public WithoutScalarSwitches,
                 public WithoutCommand,
                 public WithoutBounds {
 public:
  struct Parameters {
    double coulomb = 0.0;  ///< Fc >= 0 [N or N m]
    double viscous = 0.0;  ///< c >= 0 [N s/m or N m s/rad]
    double speed = 1e-3;   ///< vs > 0 [m/s or rad/s]
  };

  /// @throws InputError for a value outside its range.
  explicit Friction(const Parameters& parameters);

  [[nodiscard]] const Parameters& parameters() const { return parameters_; }
  [[nodiscard]] ScalarResponse evaluate(const ScalarMotion& motion,
                                        const EvaluationTime& now = {},
                                        const SwitchModes& modes = {}) const;
  [[nodiscard]] ScalarResponse evaluate_over_step(
      const CoordinateStep& coordinate, const StepTimes& times,
      const SwitchModes& modes) const;

 private:
  Parameters parameters_;
};

constexpr auto fields_of(const Friction::Parameters*) {
  return list_fields("friction", "coulomb [N, N m]",
                     "viscous [N s/m, N m s/rad]", "speed [m/s, rad/s]");
}

}  // namespace limber::joints
