// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "joints/motion.hpp"

namespace limber::joints {

/// Spring and viscous damper along the line between the two frame origins.
///
/// Equation   f on M = -(k (l - l0) + c ldot) e, l = |p_FM|, e = p_FM / l,
///            V = k (l - l0)^2 / 2, dissipation c ldot^2.
///            With l0 = 0 the spring is k p' p / 2, smooth everywhere, and
///            its damper acts on all of v: dissipation c v' v.
/// Source     elementary.
/// Limits     for l0 > 0 the direction e has no meaning at l = 0.
class PointSpring {
 public:
  struct Parameters {
    double stiffness = 0.0;    ///< k >= 0 [N/m]
    double damping = 0.0;      ///< c >= 0 [N s/m]
    double free_length = 0.0;  ///< l0 >= 0 [m]
  };

  /// Lengths below this share of the free length have no direction [-].
  static constexpr double kMinLengthRatio = 1e-9;

  /// @throws InputError if a parameter is outside its range.
  explicit PointSpring(const Parameters& parameters);

  [[nodiscard]] const Parameters& parameters() const { return parameters_; }
  /// @throws NumericalError if the ends coincide and l0 > 0.
  [[nodiscard]] CouplerResponse evaluate(const RelativeMotion& motion) const;

 private:
  Parameters parameters_;
};

}  // namespace limber::joints
