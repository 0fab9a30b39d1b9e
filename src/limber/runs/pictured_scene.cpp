// SPDX-License-Identifier: BSD-3-Clause
#include "limber/runs/pictured_scene.hpp"

#include <fmt/format.h>

#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "limber/common/errors.hpp"
#include "limber/common/files/input_file.hpp"
#include "limber/common/overloaded.hpp"
#include "limber/scene/contacts/triangle_file.hpp"
#include "limber/scene/probes/stress_points.hpp"

namespace limber::runs {
namespace {

constexpr InputKind kText = {"scenario or robot file", std::uint64_t{1} << 28};

std::string read_whole(const std::filesystem::path& file) {
  if (file.empty()) return "";  // a scene that a program made
  return read_input(file, kText);
}

/// Triangles with corners at the same place merged.
results::SolidShape read_mesh(const scene::MeshGeometry& geometry) {
  results::SolidShape form{"mesh", Vector3::Zero(), {}, {}};
  std::map<std::array<double, 3>, std::uint32_t> known;
  std::vector<Vector3> points;
  for (const scene::Triangle& triangle : scene::read_triangles(geometry)) {
    for (const Vector3& x : triangle) {
      const auto [place, is_new] = known.try_emplace(
          {x.x(), x.y(), x.z()}, static_cast<std::uint32_t>(points.size()));
      if (is_new) points.push_back(x);
      form.corners.push_back(place->second);
    }
  }
  form.x.resize(3, std::ssize(points));
  for (std::size_t i = 0; i < points.size(); ++i) {
    form.x.col(static_cast<Eigen::Index>(i)) = points[i];
  }
  return form;
}

/// Nothing for geometry without a shape here.
std::optional<results::SolidShape> find_solid_shape(
    const scene::Geometry& geometry) {
  using Form = std::optional<results::SolidShape>;
  const auto make = [](const char* kind, const Vector3& size) -> Form {
    return results::SolidShape{kind, size, {}, {}};
  };
  return std::visit(
      Overloaded{
          [&](const scene::SphereGeometry& sphere) {
            return make("sphere", {sphere.radius, 0.0, 0.0});
          },
          [&](const scene::BoxGeometry& box) { return make("box", box.size); },
          [&](const scene::CylinderGeometry& cylinder) {
            return make("cylinder", {cylinder.radius, cylinder.length, 0.0});
          },
          [&](const scene::CapsuleGeometry& capsule) {
            return make("capsule", {capsule.radius, capsule.length, 0.0});
          },
          [&](const scene::ConeGeometry& cone) {
            return make("cone", {cone.radius, cone.length, 0.0});
          },
          [&](const scene::EllipsoidGeometry& ellipsoid) {
            return make("ellipsoid", ellipsoid.radii);
          },
          [&](const scene::PlaneGeometry&) {
            return make("plane", Vector3::Zero());
          },
          [](const scene::MeshGeometry& mesh) -> Form {
            return read_mesh(mesh);
          },
          [](const scene::OtherGeometry&) -> Form { return {}; }},
      geometry);
}

void add_link(const scene::Link& link, results::Scenery& scenery,
              std::vector<std::string>& unread) {
  const bool has_visuals = !link.visuals.empty();
  const auto& given = has_visuals ? link.visuals : link.collisions;
  for (const scene::Collision& shape : given) {
    try {
      if (auto form = find_solid_shape(shape.geometry)) {
        scenery.shapes.push_back(
            {link.name, dynamics::kWorld, shape.X_LS, std::move(*form)});
      }
    } catch (const InputError& error) {
      unread.push_back(fmt::format("<{}> of link '{}': {}",
                                   has_visuals ? "visual" : "collision",
                                   link.name, error.what()));
    }
  }
}

/// Shapes in the frames of their links.
/// @param unread why shapes of links are missing
results::Scenery read_scenery(const scene::Scene& scene,
                              std::vector<std::string>& unread) {
  results::Scenery scenery;
  scenery.name = scene.scenario.name;
  scenery.scenario = read_whole(scene.scenario.file);
  if (scene.scenario.robots.empty()) {
    scenery.robots.push_back({"", read_whole(scene.scenario.robot)});
  }
  for (const scene::RobotSpec& robot : scene.scenario.robots) {
    scenery.robots.push_back({robot.name, read_whole(robot.file)});
  }
  for (const scene::Setting& setting : scene.overrides.settings) {
    scenery.settings += to_string(setting) + "\n";
  }
  for (const scene::Link& link : scene.robot.links) {
    if (!link.flexible) add_link(link, scenery, unread);
    if (link.flexible && scene::wants_stress(scene.scenario, link.name)) {
      scenery.stressed.push_back(link.name);
    }
  }
  return scenery;
}

void warn_of_unread(const std::vector<std::string>& unread,
                    std::vector<std::string>& warnings) {
  if (unread.empty()) return;
  warnings.push_back(
      fmt::format("meshes that are not drawn: {}, {}{}", unread.size(),
                  unread.size() > 1 ? "the first: " : "", unread.front()));
}

void place_shapes(const scene::Scene& scene, const scene::BuiltScene& built,
                  results::Scenery& scenery) {
  std::map<std::string, scene::PlacedLink> places;
  for (std::size_t i = 0; i < scene.robot.links.size(); ++i) {
    places[scene.robot.links[i].name] = built.links[i];
  }
  for (results::SceneryShape& shape : scenery.shapes) {
    const scene::PlacedLink& place = places.at(shape.name);
    shape.body = place.body;
    shape.X_BS = place.X_BL * shape.X_BS;
  }
  for (const scene::ObstacleSpec& obstacle : scene.scenario.obstacles) {
    if (auto form = find_solid_shape(obstacle.geometry)) {
      scenery.shapes.push_back(
          {obstacle.name, dynamics::kWorld, obstacle.X_WS, std::move(*form)});
    }
  }
}

}  // namespace

PicturedScene build_pictured(const scene::Scene& scene,
                             const Reductions& reductions) {
  std::vector<std::string> unread;
  PicturedScene made;
  made.scenery = read_scenery(scene, unread);
  made.built = scene::build_system(scene, reductions.reducer, reductions.cache,
                                   reductions.make_full);
  warn_of_unread(unread, made.built.warnings);
  place_shapes(scene, made.built, made.scenery);
  return made;
}

}  // namespace limber::runs
