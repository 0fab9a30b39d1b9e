// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/dynamics/analysis/small_motion.hpp"

namespace limber::dynamics {

/// Small motion of a set of bodies that is independent of the other bodies.
struct GroupMotion {
  /// In their coordinates, with the links that these move; `damping`,
  /// velocities and frames are left out.
  SmallMotion motion;
  std::vector<Eigen::Index> coordinates;  ///< of the whole, in that order
};

/// @param group bodies that are linked to no others
[[nodiscard]] GroupMotion take_group(const SystemModel& model,
                                     const SmallMotion& motion,
                                     const std::vector<BodyIndex>& group);

/// Of each linked group among the motion's bodies that has coordinates.
[[nodiscard]] std::vector<GroupMotion> split_groups(const SystemModel& model,
                                                    const SmallMotion& motion);

}  // namespace limber::dynamics
