// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>

namespace limber::contact {

/// Elastic normal force of one contact point: Hertz's flattening of the two
/// surfaces in series with the residual flexibility of the bodies' bases.
///
/// Equation   d = (f/k)^(2/3) + R f, with s = cbrt(f): d = c s^2 + R s^3,
///            c = k^(-2/3); V = 2/5 c s^5 + R f^2 / 2 with dV/dd = f;
///            dV/dR = -f^2 / 2 at constant d. R is negative where the modes
///            have part of the flattening already; then this holds up to
///            s = c / (3 |R|), where df/dd = 1 / |R|, and beyond it df/dd stays
/// Source     Hertz: [@johnson1985, ch. 4]
/// Limits     the area of contact is small compared with the radii, and the
///            contact long compared with the travel time of waves through the
///            parts of the bodies that R represents
class HertzLaw {
 public:
  /// k of surfaces that do not flatten: d = R f [N/m^1.5].
  static constexpr double kRigid = std::numeric_limits<double>::infinity();
  struct Parameters {
    double stiffness = 0.0;  ///< k > 0, or kRigid [N/m^1.5]
    double residual = 0.0;   ///< R, of any sign; > 0 if k is kRigid [m/N]
  };

  struct Response {
    double force = 0.0;            ///< f >= 0 [N]
    double stiffness = 0.0;        ///< df/dd [N/m]
    double hertz_depth = 0.0;      ///< (f/k)^(2/3) [m]
    double residual_depth = 0.0;   ///< the rest of d, R f [m]
    double hertz_energy = 0.0;     ///< 2/5 f (f/k)^(2/3) [J]
    double residual_energy = 0.0;  ///< the rest of V, R f^2 / 2 [J]

    [[nodiscard]] double energy() const {
      return hertz_energy + residual_energy;
    }
  };

  /// @throws InputError for a value outside its range.
  explicit HertzLaw(const Parameters& parameters);

  [[nodiscard]] const Parameters& parameters() const { return parameters_; }

  /// At a depth d [m], by Newton's method to round-off; all zero at d <= 0, all
  /// NaN if d is NaN.
  [[nodiscard]] Response evaluate(double depth) const;

  /// The state in which it stores `energy` [J] >= 0, such as the deepest point
  /// of an impact; its depth is hertz_depth + residual_depth.
  /// @throws ContractError for an energy < 0 or NaN.
  [[nodiscard]] Response find_state_of_energy(double energy) const;

 private:
  /// cbrt(f) at a depth > 0, up to depth_limit_.
  [[nodiscard]] double find_root(double depth) const;
  [[nodiscard]] Response evaluate_root(double s) const;
  /// At a depth beyond depth_limit_ by `beyond` [m].
  [[nodiscard]] Response extend(double beyond) const;

  Parameters parameters_;
  double cbrt_stiffness_ = 0.0;  // cbrt(k)
  double cbrt_residual_ = 0.0;   // cbrt(R)
  double compliance_ = 0.0;      // c
  double root_limit_ = 0.0;      // cbrt(f) up to which the cubic holds
  double depth_limit_ = 0.0;     // the depth there [m]
};

}  // namespace limber::contact
