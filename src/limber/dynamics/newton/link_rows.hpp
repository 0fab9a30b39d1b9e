// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/equations/workspace.hpp"

/// Rows of NewtonMatrix: the relative motion of couplers and transmissions
/// (links) per increment of a body.
namespace limber::dynamics {

/// Rows of the motion of M in F, from those of the motion of F: minus the
/// motion of F, plus p x rotation. @param p from Fo to Mo, in F [m]
void reflect_rows(const Vector3& p, Matrix6X& rows);

/// The motion of a coordinate, in the first row, from that of a frame.
void contract_rows(const Vector6& gradient, Matrix6X& rows);

/// Stiffness plus `velocity` [1/s] times damping of a coupler or, after all
/// couplers, of a transmission.
[[nodiscard]] Matrix6 find_link_stiffness(const SystemTerms& terms,
                                          std::size_t link, double velocity);

}  // namespace limber::dynamics
