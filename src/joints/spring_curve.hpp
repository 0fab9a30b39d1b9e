// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace limber::joints {

/// What a spring pulls back with at an extension s: force [N] by length [m], or
/// moment [N m] by angle [rad].
///
/// Equation   f = k s + k2 s |s|,  E = k s^2 / 2 + k2 |s|^3 / 3,
///            or linear between the points of a table, on outside them with
///            the slope of its ends, and E the integral from s = 0
/// Source     quadratic: the report's connection f = -K x^2
class SpringCurve {
 public:
  struct Parameters {
    double stiffness = 0.0;           ///< k >= 0
    double quadratic = 0.0;           ///< k2 >= 0
    std::vector<double> extensions;   ///< of a table, increasing
    std::vector<double> forces = {};  ///< none or two or more, not decreasing
  };
  struct Point {
    double force = 0.0;
    double energy = 0.0;  ///< [J]
    double slope = 0.0;   ///< d force / d s
  };

  SpringCurve() = default;
  /// @throws InputError for a value outside its range.
  explicit SpringCurve(const Parameters& parameters);

  [[nodiscard]] const Parameters& parameters() const { return parameters_; }
  [[nodiscard]] Point evaluate(double extension) const;

 private:
  // Up to a constant.
  [[nodiscard]] Point evaluate_table(double extension) const;

  Parameters parameters_;
  std::vector<double> energies_;  // at the table's points, from the first on
  double energy_at_rest_ = 0.0;
};

}  // namespace limber::joints
