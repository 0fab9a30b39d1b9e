// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/run/run_scenery.hpp"

#include <variant>

#include "limber/common/files/input_file.hpp"
#include "limber/common/overloaded.hpp"

namespace limber::app {
namespace {

constexpr InputKind kText = {"scenario or robot file", std::uint64_t{1} << 28};

std::string read_whole(const std::filesystem::path& file) {
  if (file.empty()) return "";  // a scene that a program made
  return read_input(file, kText);
}

void describe(const scene::Geometry& geometry, results::SceneryShape& shape) {
  std::visit(
      Overloaded{[&](const scene::SphereGeometry& sphere) {
                   shape.kind = "sphere";
                   shape.size = {sphere.radius, 0.0, 0.0};
                 },
                 [&](const scene::BoxGeometry& box) {
                   shape.kind = "box";
                   shape.size = box.size;
                 },
                 [&](const scene::CylinderGeometry& cylinder) {
                   shape.kind = "cylinder";
                   shape.size = {cylinder.radius, cylinder.length, 0.0};
                 },
                 [&](const scene::CapsuleGeometry& capsule) {
                   shape.kind = "capsule";
                   shape.size = {capsule.radius, capsule.length, 0.0};
                 },
                 [&](const scene::PlaneGeometry&) { shape.kind = "plane"; },
                 [](const scene::MeshGeometry&) {},
                 [](const scene::OtherGeometry&) {}},
      geometry);
}

void add_link(const scene::Link& link, const scene::PlacedLink& place,
              results::Scenery& scenery) {
  const auto& given = link.visuals.empty() ? link.collisions : link.visuals;
  for (const scene::Collision& collision : given) {
    results::SceneryShape shape;
    shape.name = link.name;
    shape.body = place.body;
    shape.X_BS = place.X_BL * collision.X_LS;
    describe(collision.geometry, shape);
    if (!shape.kind.empty()) scenery.shapes.push_back(shape);
  }
}

}  // namespace

results::Scenery read_scenery_texts(const scene::Scene& scene) {
  results::Scenery scenery;
  scenery.name = scene.scenario.name;
  scenery.scenario = read_whole(scene.scenario.file);
  if (scene.scenario.robots.empty()) {
    scenery.robots.push_back({"", read_whole(scene.scenario.robot)});
  }
  for (const scene::RobotSpec& robot : scene.scenario.robots) {
    scenery.robots.push_back({robot.name, read_whole(robot.file)});
  }
  for (const scene::Setting& setting : scene.settings) {
    scenery.settings += to_string(setting) + "\n";
  }
  return scenery;
}

void add_shapes(const scene::Scene& scene, const scene::BuiltScene& built,
                results::Scenery& scenery) {
  for (std::size_t i = 0; i < scene.robot.links.size(); ++i) {
    const scene::Link& link = scene.robot.links[i];
    if (!link.flexible) add_link(link, built.links[i], scenery);
  }
  for (const scene::ObstacleSpec& obstacle : scene.scenario.obstacles) {
    results::SceneryShape shape;
    shape.name = obstacle.name;
    shape.X_BS = obstacle.X_WS;
    describe(obstacle.geometry, shape);
    if (!shape.kind.empty()) scenery.shapes.push_back(shape);
  }
}

}  // namespace limber::app
