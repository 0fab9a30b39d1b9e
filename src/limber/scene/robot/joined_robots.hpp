// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/common/pose.hpp"
#include "limber/scene/robot/robot.hpp"

namespace limber::scene {

/// One of several robots of a scene.
struct NamedRobot {
  std::string name;  ///< unique, without a dot
  Robot robot;
  Pose X_WR;              ///< of its root link at the start
  bool is_fixed = false;  ///< to the world, there
};

/// Whether a robot is fixed to the world: its root link represents the world,
/// or is clamped.
[[nodiscard]] bool is_held(const Robot& robot);

/// The robot with its root link fixed to the world at X_WR: a new root "world",
/// from which a fixed joint "base" leads to it ("base_" if there is one).
/// @throws InputError if the root link is flexible, or another link is called
/// "world".
[[nodiscard]] Robot fix_base(Robot robot, const Pose& X_WR);

/// The robot with ideal joints in place of those whose stiffness its file
/// leaves open.
[[nodiscard]] Robot make_joints_ideal(Robot robot);

/// One tree of all robots: its root is the world, from which a joint with the
/// robot's name leads to the robot's root link, a fixed one if the robot is
/// held or fixed, else a floating one without coordinates at the start. Links,
/// joints and couplers of a robot are called NAME.OWN_NAME. "world" stays the
/// world as the end of a coupler, unless it is the robot's root link.
[[nodiscard]] Robot join_robots(const std::vector<NamedRobot>& robots);

}  // namespace limber::scene
