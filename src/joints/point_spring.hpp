// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "joints/motion.hpp"
#include "joints/scalar_spring.hpp"

namespace limber::joints {

/// Spring and damper along the line between the two frame origins.
///
/// Equation   f on M = -(f(s) + c ldot) e, s = l - l0, l = |p_FM|,
///            e = p_FM / l, with SpringCurve's f; dissipation c ldot^2.
///            With l0 = 0, without a table and not tension-only it is smooth
///            everywhere, and its damper acts on all of v: dissipation c v' v.
/// Source     elementary; f = k2 s |s| is the report's connection.
/// Limits     otherwise the direction e has no meaning at l = 0, unless a line
///            is slack there.
class PointSpring {
 public:
  struct Parameters {
    double stiffness = 0.0;               ///< k >= 0 [N/m]
    double damping = 0.0;                 ///< c >= 0 [N s/m]
    double free_length = 0.0;             ///< l0 >= 0 [m]
    double quadratic = 0.0;               ///< k2 >= 0 [N/m^2]
    std::vector<double> extensions = {};  ///< of a table, see SpringCurve [m]
    std::vector<double> forces = {};      ///< [N]
    bool tension_only = false;            ///< a line: never pushes
  };

  /// Lengths below this share of the free length have no direction [-].
  static constexpr double kMinLengthRatio = 1e-9;

  /// @throws InputError if a parameter is outside its range.
  explicit PointSpring(const Parameters& parameters);

  [[nodiscard]] const Parameters& parameters() const { return parameters_; }
  /// @throws NumericalError if the ends coincide and the line has no direction.
  [[nodiscard]] CouplerResponse evaluate(const RelativeMotion& motion,
                                         SwitchMode mode = {}) const;

  /// Positive while a line that only pulls is taut.
  [[nodiscard]] int switch_count() const { return line_.switch_count(); }
  [[nodiscard]] SwitchValue find_switch(const RelativeMotion& motion) const;

 private:
  [[nodiscard]] CouplerResponse evaluate_without_length(
      const RelativeMotion& motion) const;

  Parameters parameters_;
  ScalarSpring line_;
  bool has_no_length_;
};

}  // namespace limber::joints
