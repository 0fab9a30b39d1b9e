// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/contacts/projectiles.hpp"

namespace limber::scene {

Link make_link(const ProjectileSpec& projectile) {
  Link link;
  link.name = projectile.name;
  const double moment =
      0.4 * projectile.mass * projectile.radius * projectile.radius;
  link.inertia = LinkInertia{projectile.mass, Vector3::Zero(),
                             moment * Matrix3::Identity()};
  link.collisions.emplace_back().geometry = SphereGeometry{projectile.radius};
  link.contact.material = projectile.material;
  return link;
}

void add_projectiles(const Scenario& scenario, Robot& robot) {
  for (const ProjectileSpec& projectile : scenario.projectiles) {
    robot.links.push_back(make_link(projectile));
  }
}

}  // namespace limber::scene
