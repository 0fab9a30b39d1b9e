// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "joints/motion.hpp"

namespace limber::joints {

/// What a universal joint holds: its two origins together, and an axis a of F
/// normal to an axis b of M.
///
/// Equation   V = kt p' p / 2 + kr s^2 / 2, s = a . R_FM b;
///            dissipation ct v' v + cr sdot^2
/// Source     the constraint of a cross, with compliance
/// Limits     the moment is that of a sine: a tilt of pi / 2 of b towards a is
///            an unstable equilibrium.
class UniversalHold {
 public:
  struct Parameters {
    Vector3 axis_F = Vector3::UnitX();     ///< a, made a unit vector
    Vector3 axis_M = Vector3::UnitY();     ///< b, likewise, normal to a
    double translational_stiffness = 0.0;  ///< kt >= 0 [N/m]
    double rotational_stiffness = 0.0;     ///< kr >= 0 [N m/rad]
    double translational_damping = 0.0;    ///< ct >= 0 [N s/m]
    double rotational_damping = 0.0;       ///< cr >= 0 [N m s/rad]
  };

  /// @throws InputError if the axes are not normal to each other, or a value
  /// is outside its range.
  explicit UniversalHold(const Parameters& parameters);

  [[nodiscard]] const Parameters& parameters() const { return parameters_; }
  [[nodiscard]] CouplerResponse evaluate(const RelativeMotion& motion) const;

 private:
  Parameters parameters_;
};

}  // namespace limber::joints
