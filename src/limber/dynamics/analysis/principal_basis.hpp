// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/analysis/small_motion.hpp"

namespace limber::dynamics {

/// Principal coordinates of small motion: x = Q q with Q' M Q = 1, free ones
/// first. Free motion is the null space of S: of all couplers, whatever their
/// stiffness, where the rest of S is round-off. In the others the symmetric
/// part of Q' S Q is diagonal and increases. Each coordinate moves one linked
/// group, whose own stiffness decides what is round-off.
struct PrincipalBasis {
  MatrixX Q;                 ///< square [column's / kg^1/2 m]
  Eigen::Index free = 0;     ///< columns of free motion
  Eigen::Index drift = 0;    ///< the first of these: translations of the groups
                             ///< that nothing ties to the world
  VectorX squares;           ///< of the others' frequencies [1/s^2]
  bool is_symmetric = true;  ///< S, within the round-off of each group
};

/// Limits     dense: (6 bodies + modes)^3, of a linked group
[[nodiscard]] PrincipalBasis find_principal_basis(const SystemModel& model,
                                                  const SmallMotion& motion);

/// Whether there is no damping and S is symmetric.
[[nodiscard]] bool is_conservative(const SmallMotion& motion,
                                   const PrincipalBasis& basis);

}  // namespace limber::dynamics
