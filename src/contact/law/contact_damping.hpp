// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace limber::contact {

/// Damping of a normal force, and the restitution that it causes.
struct ContactDamping {
  double coefficient = 0.0;  ///< b [s/m]
  double restitution = 1.0;  ///< of an impact at `speed` [-]
  double speed = 0.0;        ///< [m/s]
};

/// Smaller restitutions use the b of this one: the body then keeps 1e-4 of its
/// energy, and touches for up to 7.2 times as long as without damping. At 0 it
/// would stop at once, under an infinite force [-].
inline constexpr double kLeastRestitution = 0.01;
/// Slower touches use the b of this speed, and so lose less energy: b grows
/// without bound as 1 / speed, and a contact that begins at rest may be moved
/// faster afterwards [m/s].
inline constexpr double kLeastTouchSpeed = 1e-5;

/// The b with which two free bodies that touch at `speed` part at `restitution`
/// times it, for any masses and elastic law. The result contains the
/// restitution and the speed that it is for.
///
/// Source     find_restitution_damping (common/restitution.hpp)
/// @param restitution e in [0, 1] [-]
/// @param speed normal approach at first touch >= 0 [m/s]
/// @throws InputError for a restitution outside its range; ContractError for a
/// speed that is.
[[nodiscard]] ContactDamping find_contact_damping(double restitution,
                                                  double speed);

/// f and its derivative, of an elastic law: at a depth, or over a step.
struct ElasticForce {
  double force = 0.0;      ///< f >= 0 [N]
  double stiffness = 0.0;  ///< df/dd [N/m]
};

/// A damped normal force.
struct DampedForce {
  double force = 0.0;        ///< >= 0 [N]
  double dissipation = 0.0;  ///< >= 0 [W]
  double stiffness = 0.0;    ///< d force / d depth [N/m]
  double damping = 0.0;      ///< d force / d rate [N s/m]
  bool is_cut = false;       ///< whether it would pull, and is 0 instead
};

/// Equation   force = f max(0, 1 + b d'); dissipation f b d'^2, or -f d' where
///            the bodies part faster than 1/b: the force is then cut to 0, and
///            what was stored is lost
/// Source     [@hunt1975]; the cut as of end stops
/// @param rate d', over a step its mean [m/s]
/// @param coefficient b >= 0 [s/m]
[[nodiscard]] DampedForce damp(const ElasticForce& elastic, double rate,
                               double coefficient);

}  // namespace limber::contact
