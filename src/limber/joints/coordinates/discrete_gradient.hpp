// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "limber/common/evaluation_time.hpp"
#include "limber/joints/coordinates/axis_coordinate.hpp"
#include "limber/joints/coordinates/motion.hpp"
#include "limber/joints/coordinates/scalar_motion.hpp"
#include "limber/joints/coordinates/switches.hpp"

/// Forces of laws over a step for which energies balance exactly, not only to
/// some order in the step.
///
/// Equation   E_1 - E_0 = h (supplied - dissipation - wrench . velocity),
///            with the law at the mean of both ends' motions and the velocity
///            that takes one end to the other, p_1 = p_0 + h v,
///            R_1 = cay(h w) R_0. Energies of bushings and constraint springs
///            are polynomials of p and R of second degree at most, for which
///            this holds without correction; a law of one coordinate z has the
///            elastic force -(E_1 - E_0) / (z_1 - z_0), and an angle's gradient
///            g is corrected along w so that h g . w = z_1 - z_0.
/// Source     discrete gradients: [@gonzalez1996]
/// Limits     a drive's force is that at the mean; the remainder of the energy
///            balance counts as supplied.
namespace limber::joints {

/// Begin and end of a step; end - begin equals h up to round-off.
struct StepTimes {
  double begin = 0.0;                       ///< [s]
  double end = 0.0;                         ///< [s]
  double h = 0.0;                           ///< > 0 [s]
  std::span<const InputState> inputs = {};  ///< constant in between

  [[nodiscard]] double middle() const { return begin + 0.5 * h; }
};

/// A coordinate at both ends of a step. The end is that of the rate, without
/// the round-off of the places of both frames: over a small step it would be a
/// large part of the force.
struct CoordinateStep {
  double z0 = 0.0;                     ///< [m or rad]
  double z1 = 0.0;                     ///< z0 + h rate [m or rad]
  double rate = 0.0;                   ///< (z1 - z0) / h [m/s or rad/s]
  Vector6 gradient = Vector6::Zero();  ///< with rate = gradient . velocity [-]
  /// As that of CoordinateValue, approximate [1/rad].
  Matrix3 hessian = Matrix3::Zero();
};

/// A coupler's motion at both ends of a step and over it.
struct MotionStep {
  const RelativeMotion& begin;
  const RelativeMotion& end;
  /// Means of both ends (also of R_FM, entry by entry), and the velocities that
  /// take one to the other.
  const RelativeMotion& mean;
};

/// A coordinate over a step.
/// @param near as for evaluate(AxisCoordinate) [rad]
/// @param h length of the step [s]
/// @throws NumericalError as evaluate(AxisCoordinate) does.
[[nodiscard]] CoordinateStep find_coordinate_step(
    const AxisCoordinate& coordinate, const MotionStep& motion, double near,
    double h);

/// Energies at both ends of a step, and powers over it.
struct StepBalance {
  double energy0 = 0.0;      ///< [J]
  double energy1 = 0.0;      ///< [J]
  double h = 0.0;            ///< > 0 [s]
  double dissipation = 0.0;  ///< [W]
  double supplied = 0.0;     ///< [W]
  double power = 0.0;        ///< of the law's force on the moving frame [W]
  double force = 0.0;        ///< along the coordinate [N or N m]
  double z0 = 0.0;           ///< the coordinate, which rounds [m or rad]
  double z1 = 0.0;           ///< [m or rad]
};

/// Power missing in the energy balance [W]; 0 if it is round-off.
[[nodiscard]] double find_lack(const StepBalance& balance);

/// A scalar law at both ends of a step and at their mean, with the mean rate.
/// Commands of drives are their limits from within the step.
struct ScalarStep {
  double energy0 = 0.0;     ///< [J]
  double energy1 = 0.0;     ///< [J]
  ScalarResponse response;  ///< at the mean
};
template <typename Law>
[[nodiscard]] ScalarStep evaluate_ends(const Law& law,
                                       const CoordinateStep& coordinate,
                                       const StepTimes& times,
                                       const SwitchModes& modes) {
  const auto at = [&](double z, double t, Side side) {
    return law.evaluate({z, coordinate.rate}, {t, side, times.inputs}, modes);
  };
  const double z = 0.5 * (coordinate.z0 + coordinate.z1);
  return {at(coordinate.z0, times.begin, Side::right).energy,
          at(coordinate.z1, times.end, Side::left).energy,
          at(z, times.middle(), Side::right)};
}

/// A scalar law at the mean, its force corrected so that energies balance.
/// @param h length of the step [s]
[[nodiscard]] ScalarResponse balance(const ScalarStep& step,
                                     const CoordinateStep& coordinate,
                                     double h);

}  // namespace limber::joints
