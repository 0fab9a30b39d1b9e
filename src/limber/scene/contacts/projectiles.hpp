// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/scene/robot/robot.hpp"
#include "limber/scene/scenario/scenario.hpp"

namespace limber::scene {

/// A rigid link with the projectile's mass, its moment of inertia
/// 2/5 m r^2, and its sphere.
[[nodiscard]] Link make_link(const ProjectileSpec& projectile);

/// Adds every projectile as a free link after those of the tree, so that
/// loads, probes and contacts find it by name. Does not check names.
void add_projectiles(const Scenario& scenario, Robot& robot);

}  // namespace limber::scene
