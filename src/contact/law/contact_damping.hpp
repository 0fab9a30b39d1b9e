// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Damping of normal forces by what a touch is at now: nothing is remembered.
namespace limber::contact {

/// f and the derivatives of an elastic law: at a depth, or over a step.
struct ElasticForce {
  double force = 0.0;      ///< f >= 0 [N]
  double stiffness = 0.0;  ///< df/dd [N/m]
  /// dW/dd of the energy by which it is damped: f at a depth [N].
  double energy_slope = 0.0;
};

/// All points at which two bodies touch, together.
struct TouchMotion {
  double force = 0.0;   ///< F = sum f [N]
  double square = 0.0;  ///< S = sum f d'^2 [N m^2/s^2]
  double energy = 0.0;  ///< W, elastic [J]
  double inverse_mass =
      0.0;  ///< 1/m of both bodies, see TouchCompliance [1/kg]

  void add(const ElasticForce& elastic, double rate, double stored) {
    force += elastic.force;
    square += elastic.force * rate * rate;
    energy += stored;
  }
};

/// s with its derivatives.
struct DampingRate {
  double s = 0.0;          ///< [s/m]
  double by_force = 0.0;   ///< ds/dF [s/(m N)]
  double by_square = 0.0;  ///< ds/dS [s^3/(N m^3)]
  double by_energy = 0.0;  ///< ds/dW [s/(m J)]
};

/// Equation   s = beta / sqrt(S / F + 2 W / m); of one point of a free impact
///            beta / sqrt(d'^2 + 2 W / m), so that its |s d'| <= beta
/// Source     find_restitution_factor (common/restitution.hpp)
/// @param factor beta >= 0 [-]
/// @return all zero of bodies at rest without energy
[[nodiscard]] DampingRate find_damping(double factor,
                                       const TouchMotion& motion);

/// A damped normal force.
struct DampedForce {
  double force = 0.0;        ///< >= 0 [N]
  double dissipation = 0.0;  ///< >= 0 [W]
  double stiffness = 0.0;    ///< d force / d depth [N/m]
  double damping = 0.0;      ///< d force / d rate [N s/m]
  bool is_cut = false;       ///< whether it would pull, and is 0 instead
};

/// Of one point.
///
/// Equation   force = f max(0, 1 + s d'); dissipation f s d'^2, or -f d' where
///            the bodies part faster than 1/s: the force is then cut to 0, and
///            what was stored is lost
/// Source     [@hunt1975], with the s of find_damping; the cut as of end stops
/// Limits     the derivatives take the other points of the touch as held
/// @param rate d', over a step its mean [m/s]
[[nodiscard]] DampedForce damp(const ElasticForce& elastic, double rate,
                               const DampingRate& damping);

}  // namespace limber::contact
