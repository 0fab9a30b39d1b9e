// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>

#include "limber/scene/scenario/contact_spec.hpp"
#include "limber/scene/text/toml_table.hpp"

/// Readers of the bodies that a scenario adds to its robot.
namespace limber::scene {

/// `position`, `orientation_rpy`, `velocity`, `angular_velocity`.
[[nodiscard]] BodyStart read_body_start(TomlTable& table);

/// The key `base` of a robot: "free" or "fixed".
[[nodiscard]] std::optional<RobotBase> read_base(TomlTable& table);
/// The key `joint` of a robot: "stiff" or "ideal".
[[nodiscard]] JointModel read_joint_model(TomlTable& table);

/// A [[robot]]. @param folder to which its file name is relative
[[nodiscard]] RobotSpec read_placed_robot(TomlTable& table,
                                          const std::filesystem::path& folder);

/// A [[projectile]].
[[nodiscard]] ProjectileSpec read_projectile(TomlTable& table);

/// An [[obstacle]].
[[nodiscard]] ObstacleSpec read_obstacle(TomlTable& table);

}  // namespace limber::scene
