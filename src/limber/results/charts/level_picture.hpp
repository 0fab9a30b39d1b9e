// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "limber/dynamics/analysis/level_observer.hpp"
#include "limber/flexbody/model/reduced_body.hpp"

namespace limber::results {

/// One body's trajectory in the plane of alpha and Omega.
struct RotationTrack {
  std::string name;
  std::shared_ptr<const flexbody::ReducedBody> reduced;
  double displacement = 0.0;  ///< neglected [m]
  double linear_limit = 0.0;  ///< [m]
  std::vector<dynamics::RotationPoint> points;
};

/// The plane of angular acceleration and velocity as in the report's Figure 9,
/// [@morrison2023], a panel for each body shape: where inertial forces may be
/// neglected, the limit of linear elasticity, the bodies' trajectories. Clamped
/// bodies and those without modes have no panel.
/// @returns an empty string, or why there is no picture.
[[nodiscard]] std::string draw_rotation_plane(
    const std::filesystem::path& file, const std::string& title,
    const std::vector<RotationTrack>& tracks);

}  // namespace limber::results
