// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "flexbody/fem_friction.hpp"
#include "flexbody/reduce_meshed_body.hpp"

/// Steady motions of a body whose deformation is then constant, by linear
/// elasticity: docs/theory/operating_states.md [@ligterink2005, sections 2, 3].
/// Loads are nodal forces on all nodes of the mesh, 3 x N in mesh axes [N];
/// they keep their direction in the body's axes. Every function throws
/// InputError for a load that is not finite, and NumericalError as
/// fem::ElasticInverse. Part of limber_reduction.
namespace limber::flexbody {

/// How far linear theory can be trusted. It leaves out H^T H / 2 of the Green
/// strain, which is this share of what it keeps where H, the displacement's
/// gradient, is twice it.
struct LinearTrust {
  static constexpr double kLimit = 0.1;

  double displacement = 0.0;  ///< largest, over the mesh's longest edge [-]
  double strain = 0.0;        ///< largest principal strain [-]
  double rotation = 0.0;      ///< largest against the body frame [rad]

  [[nodiscard]] bool is_linear() const {
    return displacement <= kLimit && strain <= kLimit && rotation <= kLimit;
  }
};
/// One sentence with the three values and the limit.
[[nodiscard]] std::string describe(const LinearTrust& trust);

/// Deformation and the steady motion that goes with it, mesh axes.
struct OperatingState {
  Matrix3X u;               ///< 3 x N, no rigid motion if the body is free [m]
  Matrix3X internal_force;  ///< K u, 3 x N; zero where clamped [N]
  double strain_energy = 0.0;  ///< [J]
  LinearTrust trust;

  Vector3 acceleration = Vector3::Zero();          ///< of the c.m. [m/s^2]
  Vector3 angular_acceleration = Vector3::Zero();  ///< [rad/s^2]
  Vector3 velocity = Vector3::Zero();              ///< of a drift [m/s]
  Vector3 angular_velocity = Vector3::Zero();      ///< [rad/s]
  std::optional<double> critical_speed;            ///< about its axis [rad/s]
  /// What the clamp gives; of a free body, what is missing for the motion to
  /// last: it is spread over the body as M times a rigid acceleration.
  Vector3 support_force = Vector3::Zero();  ///< [N]
  Vector3 support_moment =
      Vector3::Zero();  ///< about the undeformed c.m. [N m]
};

/// Constant acceleration under a constant load, from rest; of a clamped body,
/// rest.
///
/// Equation   K x = F - M q_F, q_F the rigid acceleration that F causes
/// @throws InputError without a load.
[[nodiscard]] OperatingState find_accelerating_state(const MeshedBody& body,
                                                     const Matrix3X& load);

/// Constant velocity of a free body, the load balanced by friction.
///
/// Equation   K x = F - D v, sum(F - D v) = 0
/// @throws InputError without a load or damping, for a clamped body, and for
/// a load whose line misses the centre of drag: it would turn the body.
[[nodiscard]] OperatingState find_drifting_state(const MeshedBody& body,
                                                 const Matrix3X& load,
                                                 const Friction& friction);

/// An axis fixed in the body; it need not pass through it.
struct SpinAxis {
  Vector3 direction = Vector3::UnitZ();  ///< any length but 0 [-]
  Vector3 point = Vector3::Zero();       ///< mesh frame [m]
};

/// Constant angular velocity without load or friction.
///
/// Equation   (K - Omega^2 M E) x = Omega^2 M E r, r from the axis
/// @param speed Omega, either sign [rad/s]
/// @throws InputError for a zero axis, a zero speed and one that is not below
/// the critical speed.
[[nodiscard]] OperatingState find_spinning_state(const MeshedBody& body,
                                                 const SpinAxis& axis,
                                                 double speed);

/// Constant angular velocity that friction lets a constant torque reach.
///
/// Equation   (K - Omega^2 M E) x = Omega^2 M E r + F - Omega D n x (r + x),
///            n.sum (r + x) x F = Omega sum |.|_D^2 of n x (r + x)
/// @throws InputError as the two before, without a torque about the axis, and
/// for a net force on a free body; NumericalError if speed and deformation do
/// not settle.
[[nodiscard]] OperatingState find_driven_spin_state(const MeshedBody& body,
                                                    const SpinAxis& axis,
                                                    const Matrix3X& load,
                                                    const Friction& friction);

/// Start from rest under a load that stays: from constant acceleration to
/// constant velocity, slowly enough for the deformation to follow at once.
///
/// Equation   alpha = exp(-D t / M), x = alpha x_a + (1 - alpha) x_v
struct SlowChange {
  OperatingState accelerating;  ///< at t = 0
  OperatingState drifting;      ///< at last
  double rate = 0.0;            ///< D / M [1/s]

  /// The state after a time t >= 0 [s].
  [[nodiscard]] OperatingState at(double t, const MeshedBody& body) const;
};
/// @throws InputError as find_drifting_state, and if the load turns the body.
[[nodiscard]] SlowChange find_slow_change(const MeshedBody& body,
                                          const Matrix3X& load,
                                          const Friction& friction);

}  // namespace limber::flexbody
