// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "limber/common/progress.hpp"
#include "limber/common/types.hpp"
#include "limber/scene/robot/robot.hpp"

namespace limber::app {

struct LinkMass {
  double mass = 0.0;                    ///< [kg]
  Vector3 p_LBcm = Vector3::Zero();     ///< c.m. in the link frame [m]
  std::optional<Vector3> size = {};     ///< of a flexible one's box [m]
  std::vector<std::string> warnings{};  ///< of its mesh, materials and size
};

/// Masses of a robot's links; a flexible one's by its mesh or saved body.
struct RobotMasses {
  std::vector<std::optional<LinkMass>> of_link;  ///< none: it has no mass
  double total = 0.0;                            ///< [kg]
  /// Of all, from the root link's origin in its axes, with all joints at zero.
  Vector3 center = Vector3::Zero();  ///< [m]
};

/// A mesh or body that cannot be read is a warning, and has no mass.
[[nodiscard]] RobotMasses find_masses(const scene::Robot& robot,
                                      const Progress& progress);

}  // namespace limber::app
