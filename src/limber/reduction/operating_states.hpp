// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/reduction/friction.hpp"
#include "limber/reduction/meshed_body.hpp"
#include "limber/reduction/operating_state.hpp"

/// Steady motions of a body with constant deformation, by linear elasticity:
/// docs/theory/operating_states.md [@ligterink2005, sections 2, 3]. Loads are
/// nodal forces on all nodes, 3 x N, expressed in the mesh frame [N]; their
/// direction is fixed in the body frame. Every function throws InputError for a
/// load that is not finite, and NumericalError as fem::ElasticInverse. Part of
/// limber_reduction.
namespace limber::flexbody {

/// Constant acceleration under a constant load, from rest; for a clamped body,
/// static equilibrium.
///
/// Equation   K x = F - M q_F, q_F the rigid acceleration that F causes
/// @throws InputError without a load.
[[nodiscard]] OperatingState find_accelerating_state(const MeshedBody& body,
                                                     const Matrix3X& load);

/// Constant velocity of a free body, the load balanced by friction.
///
/// Equation   K x = F - D v, sum(F - D v) = 0
/// @throws InputError without a load or damping, for a clamped body, and for
/// a load whose line of action misses the centre of drag: it would rotate the
/// body.
[[nodiscard]] OperatingState find_drifting_state(const MeshedBody& body,
                                                 const Matrix3X& load,
                                                 const Friction& friction);

/// An axis fixed in the body frame; it need not intersect the body.
struct SpinAxis {
  Vector3 direction = Vector3::UnitZ();  ///< any length but 0 [-]
  Vector3 point = Vector3::Zero();       ///< mesh frame [m]
};

/// Constant angular velocity without load or friction.
///
/// Equation   (K - Omega^2 M E) x = Omega^2 M E r, r from the axis
/// @param speed Omega, either sign [rad/s]
/// @throws InputError for a zero axis, a zero speed, or a speed at or above the
/// critical one.
[[nodiscard]] OperatingState find_spinning_state(const MeshedBody& body,
                                                 const SpinAxis& axis,
                                                 double speed);

/// Constant angular velocity at which friction balances a constant torque.
///
/// Equation   (K - Omega^2 M E) x = Omega^2 M E r + F - Omega D n x (r + x),
///            n.sum (r + x) x F = Omega sum |.|_D^2 of n x (r + x)
/// @throws InputError as the two functions above, without a torque about the
/// axis, and for a net force on a free body; NumericalError if speed and
/// deformation do not converge.
[[nodiscard]] OperatingState find_driven_spin_state(const MeshedBody& body,
                                                    const SpinAxis& axis,
                                                    const Matrix3X& load,
                                                    const Friction& friction);

/// Start from rest under a constant load: from constant acceleration to
/// constant velocity, slowly enough for a quasi-static deformation.
///
/// Equation   alpha = exp(-D t / M), x = alpha x_a + (1 - alpha) x_v
struct SlowChange {
  OperatingState accelerating;  ///< at t = 0
  OperatingState drifting;      ///< as t -> infinity
  double rate = 0.0;            ///< D / M [1/s]

  /// The state after a time t >= 0 [s].
  [[nodiscard]] OperatingState at(double t, const MeshedBody& body) const;
};
/// @throws InputError as find_drifting_state, and if the load rotates the body.
[[nodiscard]] SlowChange find_slow_change(const MeshedBody& body,
                                          const Matrix3X& load,
                                          const Friction& friction);

}  // namespace limber::flexbody
