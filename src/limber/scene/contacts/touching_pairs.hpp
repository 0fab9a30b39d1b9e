// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <tuple>
#include <vector>

#include "limber/scene/robot/robot.hpp"
#include "limber/scene/scenario/scenario.hpp"

namespace limber::scene {

/// A body named by contacts: a link of the robot, projectiles included, or an
/// obstacle.
struct Toucher {
  bool is_obstacle = false;
  std::size_t index = 0;  ///< into Robot::links or Scenario::obstacles

  bool operator==(const Toucher&) const = default;
  bool operator<(const Toucher& other) const {
    return std::tie(is_obstacle, index) <
           std::tie(other.is_obstacle, other.index);
  }
};

[[nodiscard]] const std::string& name_of(const Toucher& body,
                                         const Robot& robot,
                                         const Scenario& scenario);

struct TouchingPair {
  std::size_t contact = 0;  ///< index of the one that decides how they touch
  Toucher A;                ///< of its first name
  Toucher B;
};

struct TouchingPairs {
  std::vector<TouchingPair> pairs;  ///< in the order of contacts and bodies
  /// Contacts that other contacts override in every pair.
  std::vector<std::size_t> idle;
};

/// The pairs of bodies that may touch, each once. A contact that names both
/// bodies overrides those with patterns, and of these the first applies. A
/// pattern matches bodies that have a shape. Pairs from patterns omit bodies
/// that are fixed to each other or in the world, and links that a joint (not a
/// floating one) or a loop connects directly.
/// @param robot with the projectiles
/// @throws InputError listing every problem, without the file: unknown names,
/// patterns without bodies, contacts without pairs, impossible pairs, two
/// contacts that name the same bodies, links without shapes or with unusable
/// ones.
[[nodiscard]] TouchingPairs find_touching_pairs(const Scenario& scenario,
                                                const Robot& robot);

}  // namespace limber::scene
