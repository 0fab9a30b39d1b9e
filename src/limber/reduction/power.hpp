// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/reduction/friction.hpp"

/// Energy balance of a load on a body: docs/theory/operating_states.md
/// [@ligterink2005, sections 2.1 and 7]. Loads and motions are nodal, on the
/// free nodes, 3n, mesh frame. Part of limber_reduction.
namespace limber::flexbody {

/// A load in two parts: F = F_parallel + F_perpendicular.
///
/// Equation   F_parallel = M q_f, q_f = R R^T F;  F_perpendicular^T R = 0
/// Limits     F_parallel does no work on x if R^T M x = 0.
struct LoadSplit {
  MatrixX parallel;       ///< moves the body; zero if it is clamped [N]
  MatrixX perpendicular;  ///< deforms it [N]
};
/// @param F 3n x k [N]
/// @throws InputError for values that are not finite.
[[nodiscard]] LoadSplit split_load(const MeshedBody& body, const MatrixX& F);

/// Rigid motion q and deformation x at one instant, q' = R c and R^T M x = 0.
struct BodyMotion {
  VectorX qdot;   ///< zero if clamped [m/s]
  VectorX qddot;  ///< [m/s^2]
  VectorX x;      ///< [m]
  VectorX xdot;   ///< [m/s]
  VectorX xddot;  ///< [m/s^2]; zero if quasi-static
};

struct BodyEnergy {
  double rigid = 0.0;    ///< q'^T M q' / 2 [J]
  double swing = 0.0;    ///< x'^T M x' / 2 [J]
  double elastic = 0.0;  ///< x^T K x / 2 [J]
  [[nodiscard]] double total() const { return rigid + swing + elastic; }
};
[[nodiscard]] BodyEnergy calc_energy(const MeshedBody& body,
                                     const BodyMotion& motion);

/// Power balance of a load.
///
/// Equation   F^T (q' + x') = F_parallel^T q' + F_perpendicular^T x'
///            = q'^T M q'' + x'^T M x'' + x'^T K x + (q' + x')^T D (q' + x')
/// Limits     The second line holds if the motion satisfies the
///            equations of motion, in full or on a subspace with q' and x'.
struct PowerBalance {
  double into_motion = 0.0;        ///< F_parallel^T q' [W]
  double into_deformation = 0.0;   ///< F_perpendicular^T x' [W]
  double rigid = 0.0;              ///< rate of q'^T M q' / 2 [W]
  double swing = 0.0;              ///< rate of x'^T M x' / 2 [W]
  double elastic = 0.0;            ///< rate of x^T K x / 2 [W]
  double rigid_friction = 0.0;     ///< q'^T D q' [W]
  double internal_friction = 0.0;  ///< x'^T D (q' + x') + q'^T D x' [W]

  [[nodiscard]] double supplied() const {
    return into_motion + into_deformation;
  }
  [[nodiscard]] double stored() const { return rigid + swing + elastic; }
  [[nodiscard]] double dissipated() const {
    return rigid_friction + internal_friction;
  }
  /// Error of the balance [W].
  [[nodiscard]] double residual() const {
    return supplied() - stored() - dissipated();
  }
};
/// @param F 3n, at this instant [N]
/// @throws InputError as split_load, and for friction below zero.
[[nodiscard]] PowerBalance calc_power(const MeshedBody& body, const VectorX& F,
                                      const BodyMotion& motion,
                                      const Friction& friction = {});

}  // namespace limber::flexbody
