// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/terms/system_terms.hpp"

/// Rows of NewtonMatrix: the relative motion of couplers and transmissions
/// (links) per increment of a body.
namespace limber::dynamics {

/// Rows of the motion of M in F, from those of the motion of F: minus the
/// motion of F, plus p x rotation. @param p from Fo to Mo, in F [m]
void reflect_rows(const Vector3& p, Matrix6X& rows);

/// The motion of a coordinate, in the first row, from that of a frame.
void contract_rows(const Vector6& gradient, Matrix6X& rows);

/// The constraint of an ideal joint; null for every other link.
[[nodiscard]] const joints::ConstraintGap* find_constraint(
    const SystemTerms& terms, std::size_t link);

/// One link's rows of NewtonMatrix, rotated so that no row mixes directions
/// with stiffness, without, and constrained ones.
///
/// Equation   diag(yields) rotation dw + stiffness sum_b G_b x_b = rotation s
struct LinkRows {
  Matrix6 rotation;   ///< of wrenches, block by block [-]
  Vector6 yields;     ///< 1, but 0 of constrained directions [-]
  Matrix6 stiffness;  ///< rotated; of constrained directions their projection
};
[[nodiscard]] LinkRows find_link_rows(const SystemTerms& terms,
                                      std::size_t link, double velocity);

/// Leaves of a wrench what an ideal joint transmits in free directions.
[[nodiscard]] Vector6 remove_constrained(
    const joints::ConstraintGap& constraint, const Vector6& wrench);

/// Stiffness plus `velocity` [1/s] times damping of a coupler or, after all
/// couplers, of a transmission.
[[nodiscard]] Matrix6 find_link_stiffness(const SystemTerms& terms,
                                          std::size_t link, double velocity);

}  // namespace limber::dynamics
