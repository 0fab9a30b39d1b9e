// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "limber/joints/coordinates/motion.hpp"
#include "limber/joints/coupler_law_kind.hpp"
#include "limber/joints/scalar/scalar_spring.hpp"

namespace limber::joints {

/// Spring and damper along the line between two frame origins.
///
/// Equation   f on M = -(f(s) + c ldot) e, s = l - l0, l = |p_FM|,
///            e = p_FM / l, with SpringCurve's f; dissipation c ldot^2.
///            With l0 = 0, without a table and not tension-only, it is smooth
///            everywhere, and its damper acts on all of v: dissipation c v' v.
/// Source     elementary; f = k2 s |s| is the connection of the WOBBLE report.
/// Limits     otherwise e is undefined at l = 0, unless a tension-only spring
///            is slack there.
class PointSpring : public WithoutTriggers,
                    public WithoutCoordinates,
                    public WithoutCommands,
                    public WithoutConstraint {
 public:
  struct Parameters {
    double stiffness = 0.0;               ///< k >= 0 [N/m]
    double damping = 0.0;                 ///< c >= 0 [N s/m]
    double free_length = 0.0;             ///< l0 >= 0 [m]
    double quadratic = 0.0;               ///< k2 >= 0 [N/m^2]
    std::vector<double> extensions = {};  ///< of a table, see SpringCurve [m]
    std::vector<double> forces = {};      ///< of a table [N]
    bool tension_only = false;            ///< a cable: never pushes
  };

  /// Below this ratio of length to free length e is undefined [-].
  static constexpr double kMinLengthRatio = 1e-9;

  /// @throws InputError if a parameter is outside its range.
  explicit PointSpring(const Parameters& parameters);

  [[nodiscard]] const Parameters& parameters() const { return parameters_; }
  /// @throws NumericalError if the ends coincide and e is undefined.
  [[nodiscard]] CouplerResponse evaluate(const RelativeMotion& motion,
                                         SwitchMode mode = {}) const;
  [[nodiscard]] CouplerResponse evaluate(const RelativeMotion& motion,
                                         const CouplerMemory& memory,
                                         const EvaluationTime& /*now*/) const {
    return evaluate(motion, memory.switches[0]);
  }
  /// Uses the mean and the difference of the lengths at both ends, and acts
  /// along (p_0 + p_1) / (l_0 + l_1), whose product with the velocity over the
  /// step is the rate of the length.
  [[nodiscard]] CouplerResponse evaluate_over_step(
      const MotionStep& motion, const CouplerMemory& memory,
      const StepTimes& times) const;

  [[nodiscard]] static RequiredSides find_required_rotations() { return {}; }

  /// Positive while a tension-only spring is taut.
  [[nodiscard]] int switch_count() const { return line_.switch_count(); }
  [[nodiscard]] SwitchValue find_switch(int index, const RelativeMotion& motion,
                                        const CouplerMemory& memory,
                                        double t) const;
  [[nodiscard]] static std::optional<EventKind> find_event(
      int /*index*/, bool rises, const CouplerMemory& /*memory*/) {
    return ScalarSpring::find_event(rises);
  }

  /// The length; the effort is the tension.
  [[nodiscard]] static std::vector<AxisCoordinate::Kind> reading_kinds() {
    return {AxisCoordinate::Kind::distance};
  }
  [[nodiscard]] CoordinateReading read(int coordinate,
                                       const RelativeMotion& motion,
                                       const CouplerMemory& memory,
                                       const EvaluationTime& now) const;

 private:
  [[nodiscard]] CouplerResponse evaluate_without_length(
      const RelativeMotion& motion) const;

  Parameters parameters_;
  ScalarSpring line_;
  bool has_no_length_;
};

constexpr auto fields_of(const PointSpring::Parameters*) {
  return list_fields("spring", "stiffness [N/m]", "damping [N s/m]",
                     "free length [m]", "quadratic [N/m^2]", "extensions [m]",
                     "forces [N]", "tension only");
}

}  // namespace limber::joints
