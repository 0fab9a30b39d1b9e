// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/scene/contacts/touching_pairs.hpp"
#include "limber/scene/robot/robot.hpp"
#include "limber/scene/scenario/scenario.hpp"

namespace limber::scene {

/// The first link of each group of links that falls freely under gravity: no
/// joint, coupler or contact joins it to the world, directly or through others,
/// and no load acts on it. Not of projectiles; none without gravity.
[[nodiscard]] std::vector<std::string> find_falling_links(
    const Scenario& scenario, const Robot& robot,
    const std::vector<TouchingPair>& touching);

}  // namespace limber::scene
