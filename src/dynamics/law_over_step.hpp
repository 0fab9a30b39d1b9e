// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "joints/coupler_law.hpp"

/// What couplers' laws exert over a step so that their energies balance
/// exactly, not to some order in the step.
///
/// Equation   E_1 - E_0 = h (supplied - dissipation - wrench . velocity),
///            with the law at the mean of both ends' motions and the velocity
///            that takes one end to the other, p_1 = p_0 + h v,
///            R_1 = cay(h w) R_0. Bushings and holds are polynomials of p and
///            R of second degree at most, for which this holds as it is; a
///            law of one coordinate z has force = -(E_1 - E_0) / (z_1 - z_0)
///            for its elastic share, and an angle's gradient g is changed
///            along w so that h g . w = z_1 - z_0.
/// Source     discrete gradients: [@gonzalez1996]
/// Limits     a drive's force is that at the mean; what is left of the balance
///            counts as supplied.
namespace limber::dynamics {

/// When a step begins and ends; t_end - t_begin is h but for round-off.
struct StepTimes {
  double begin = 0.0;  ///< [s]
  double end = 0.0;    ///< [s]
  double h = 0.0;      ///< > 0 [s]

  [[nodiscard]] double middle() const { return begin + 0.5 * h; }
};

/// A coordinate at both ends of a step.
struct CoordinateStep {
  double z0 = 0.0;                     ///< [m or rad]
  double z1 = 0.0;                     ///< [m or rad]
  double rate = 0.0;                   ///< (z1 - z0) / h
  Vector6 gradient = Vector6::Zero();  ///< with rate = gradient . velocity
  Matrix3 hessian = Matrix3::Zero();   ///< as CoordinateValue's, about so
};

/// A coupler's motion at both ends of a step and over it.
struct MotionStep {
  const joints::RelativeMotion& begin;
  const joints::RelativeMotion& end;
  /// Means of both ends (R_FM, too, as a matrix), and the velocities that take
  /// one to the other.
  const joints::RelativeMotion& mean;
};

/// @param near as for joints::evaluate(AxisCoordinate)
/// @throws NumericalError as it does.
[[nodiscard]] CoordinateStep find_coordinate_step(
    const joints::AxisCoordinate& coordinate, const MotionStep& motion,
    double near, double h);

[[nodiscard]] joints::ScalarResponse evaluate_over_step(
    const joints::ScalarLaw& law, const CoordinateStep& coordinate,
    const StepTimes& times, const joints::SwitchModes& modes);

/// @throws NumericalError as the law does.
[[nodiscard]] joints::CouplerResponse evaluate_over_step(
    const joints::CouplerLaw& law, const MotionStep& motion,
    const joints::CouplerMemory& memory, const StepTimes& times);

}  // namespace limber::dynamics
