// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/run/collision_shapes.hpp"

#include <map>
#include <string>

#include "limber/common/index.hpp"
#include "limber/scene/build/body_plan.hpp"
#include "limber/scene/contacts/shape_surface.hpp"

namespace limber::app {
namespace {

std::vector<scene::ReducedPointer> find_reduced(
    const scene::Robot& robot, const dynamics::SystemModel& model) {
  std::map<std::string, scene::ReducedPointer> by_name;
  for (const dynamics::BodyModel& body : model.bodies) {
    by_name[body.name] = body.reduced;
  }
  std::vector<scene::ReducedPointer> reduced;
  for (const scene::Link& link : robot.links) {
    reduced.push_back(link.flexible ? by_name.at(link.name) : nullptr);
  }
  return reduced;
}

void add_shape(const scene::Geometry& geometry, const Pose& X_BS,
               dynamics::BodyIndex body,
               std::vector<results::BodySurface>& surfaces) {
  scene::ShapeSurface surface = scene::make_surface(geometry);
  if (surface.triangles.empty()) return;
  for (Eigen::Index p = 0; p < surface.points.cols(); ++p) {
    surface.points.col(p) = X_BS * Vector3(surface.points.col(p));
  }
  surfaces.push_back({body, {surface.points, surface.triangles}});
}

}  // namespace

std::vector<results::BodySurface> find_collision_shapes(
    const scene::Scene& scene, const dynamics::SystemModel& model) {
  const scene::Robot& robot = scene.robot;
  const scene::BodyPlans plans =
      scene::plan_bodies(robot, find_reduced(robot, model));
  std::vector<results::BodySurface> surfaces;
  for (std::size_t i = 0; i < robot.links.size(); ++i) {
    const scene::BodyPlan& plan = plans.bodies[index(plans.body_of_link[i])];
    if (plan.reduced) continue;
    const dynamics::BodyIndex body =
        plan.is_world ? dynamics::kWorld : model.find_body(plan.name);
    for (const scene::Collision& collision : robot.links[i].collisions) {
      add_shape(collision.geometry, plans.X_BL[i] * collision.X_LS, body,
                surfaces);
    }
  }
  for (const scene::ObstacleSpec& obstacle : scene.scenario.obstacles) {
    add_shape(obstacle.geometry, obstacle.X_WS, dynamics::kWorld, surfaces);
  }
  return surfaces;
}

}  // namespace limber::app
