// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/common/records/fields.hpp"

namespace limber::joints {

/// Restoring force [N] of a spring at an extension s [m], or restoring moment
/// [N m] at an angle s [rad].
///
/// Equation   f = k s + k2 s |s|,  E = k s^2 / 2 + k2 |s|^3 / 3;
///            plus a table: linear between its points, extrapolated with the
///            slopes at its ends, and E the integral from s = 0
/// Source     quadratic: the connection f = -K x^2 of the WOBBLE report
class SpringCurve {
 public:
  struct Parameters {
    double stiffness = 0.0;  ///< k >= 0 [N/m or N m/rad]
    double quadratic = 0.0;  ///< k2 >= 0 [N/m^2 or N m/rad^2]
    /// Of a table, increasing: none, or at least two [m or rad].
    std::vector<double> extensions = {};
    std::vector<double> forces = {};  ///< not decreasing [N or N m]
  };
  struct Point {
    double force = 0.0;   ///< [N or N m]
    double energy = 0.0;  ///< [J]
    double slope = 0.0;   ///< d force / d s [N/m or N m/rad]
  };

  SpringCurve() = default;
  /// @throws InputError for a value outside its range.
  explicit SpringCurve(const Parameters& parameters);

  [[nodiscard]] const Parameters& parameters() const { return parameters_; }
  /// @param extension s [m or rad]
  [[nodiscard]] Point evaluate(double extension) const;

 private:
  // The table's part, its energy up to a constant.
  [[nodiscard]] Point evaluate_table(double extension) const;

  Parameters parameters_;
  std::vector<double> energies_;  // at the table's points, from the first on
  double energy_at_rest_ = 0.0;
};

constexpr auto fields_of(const SpringCurve::Parameters*) {
  return list_fields("curve", "stiffness [N/m, N m/rad]",
                     "quadratic [N/m^2, N m/rad^2]", "extensions [m, rad]",
                     "forces [N, N m]");
}

}  // namespace limber::joints
