// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "limber/dynamics/system/system_state.hpp"
#include "limber/scene/build/build_system.hpp"
#include "limber/scene/build/scene.hpp"

namespace limber::runs {

/// Start of a free body's frame in the world; what is left out is the
/// scenario's.
struct FreeStart {
  std::optional<Vector3> position = {};          ///< [m]
  std::optional<Vector3> orientation_rpy = {};   ///< [rad]
  std::optional<Vector3> velocity = {};          ///< of its origin [m/s]
  std::optional<Vector3> angular_velocity = {};  ///< [rad/s]
};

/// Where a world starts instead of where its scenario does; what is left out is
/// the scenario's.
struct WorldStart {
  /// Coordinates of joints, by their names; empty position or velocity: the
  /// scenario's.
  std::map<std::string, scene::JointStart> joints = {};
  /// Bodies that fly free, by their names: projectiles, and "base", the root
  /// link of the only robot.
  std::map<std::string, FreeStart> bodies = {};

  [[nodiscard]] bool is_empty() const {
    return joints.empty() && bodies.empty();
  }
};

/// The initial state of a built scene as it would be with these starts among
/// those of its scenario, to the bit. Bodies in contact must not overlap deeply
/// there.
/// @param notices gets one of each smaller overlap, with its force
/// @throws InputError for an unknown joint or body, with the nearest name, a
/// wrong number of coordinates, values that are not finite, overlaps; for a
/// scenario that starts in equilibrium, or has a body at level `full`.
[[nodiscard]] dynamics::SystemState find_start(
    const scene::Scene& scene, const scene::BuiltScene& built,
    const WorldStart& start, std::vector<std::string>& notices);

}  // namespace limber::runs
