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

}  // namespace

std::vector<results::BodySurface> find_collision_shapes(
    const scene::Scene& scene, const dynamics::SystemModel& model) {
  const scene::Robot& robot = scene.robot;
  const scene::BodyPlans plans =
      scene::plan_bodies(robot, find_reduced(robot, model));
  std::vector<results::BodySurface> surfaces;
  for (std::size_t i = 0; i < robot.links.size(); ++i) {
    const scene::BodyPlan& plan = plans.bodies[index(plans.body_of_link[i])];
    if (plan.is_world || plan.reduced) continue;
    for (const scene::Collision& collision : robot.links[i].collisions) {
      scene::ShapeSurface surface = scene::make_surface(collision.geometry);
      const Pose X_BS = plans.X_BL[i] * collision.X_LS;
      for (Eigen::Index p = 0; p < surface.points.cols(); ++p) {
        surface.points.col(p) = X_BS * Vector3(surface.points.col(p));
      }
      if (surface.triangles.empty()) continue;
      surfaces.push_back(
          {model.find_body(plan.name), {surface.points, surface.triangles}});
    }
  }
  return surfaces;
}

}  // namespace limber::app
