// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/analysis/small_motion.hpp"

namespace limber::dynamics {

/// Principal coordinates of small motion: x = Q q with Q' M Q = 1, free ones
/// first. Free motion is the null space of S: of all couplers, whatever their
/// stiffness, where the rest of S is round-off. In the others the symmetric
/// part of Q' S Q is diagonal.
struct PrincipalBasis {
  MatrixX Q;               ///< square [column's / kg^1/2 m]
  Eigen::Index free = 0;   ///< columns of free motion
  Eigen::Index drift = 0;  ///< the first of these: translations of all bodies
                           ///< together, if nothing ties them to the world
};

/// Limits     dense: (6 bodies + modes)^3
[[nodiscard]] PrincipalBasis find_principal_basis(const SystemModel& model,
                                                  const SmallMotion& motion);

/// Whether there is no damping and S is symmetric within round-off.
[[nodiscard]] bool is_conservative(const SmallMotion& motion,
                                   const PrincipalBasis& basis);

}  // namespace limber::dynamics
