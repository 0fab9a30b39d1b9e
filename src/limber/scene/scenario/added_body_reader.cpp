// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/scenario/added_body_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "limber/common/echo.hpp"
#include "limber/common/roll_pitch_yaw.hpp"

namespace limber::scene {
namespace {

std::optional<contact::SurfaceMaterial> read_material(TomlTable& table) {
  const auto modulus = table.number("youngs_modulus", kPositive);
  const auto ratio = table.number("poisson_ratio", {-1.0, 0.5, true, false});
  if (table.has("youngs_modulus") != table.has("poisson_ratio")) {
    table.fail("needs both 'youngs_modulus' and 'poisson_ratio', or neither");
  }
  if (!modulus || !ratio) return std::nullopt;
  return contact::SurfaceMaterial{*modulus, *ratio};
}

/// Mass of a solid sphere, given or by its density [kg].
double read_sphere_mass(TomlTable& table, double radius) {
  const auto mass = table.number("mass", kPositive);
  const auto density = table.number("density", kPositive);
  if (table.has("mass") == table.has("density")) {
    table.fail("needs one of 'mass' [kg] and 'density' [kg/m^3]");
  }
  if (mass) return *mass;
  return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius *
         density.value_or(1.0);
}

// Any axes with z along the normal: a plane is the same with all of them.
Matrix3 read_normal(TomlTable& table) {
  if (!table.has("normal")) table.fail("needs 'normal', out of the plane");
  const Vector3 normal = table.vector("normal").value_or(Vector3::UnitZ());
  if (normal.isZero(0.0)) {
    table.fail("normal", "is zero; expected a direction");
    return Matrix3::Identity();
  }
  return Quaternion::FromTwoVectors(Vector3::UnitZ(), normal.stableNormalized())
      .toRotationMatrix();
}

// @param what they are, such as "the edges"
Vector3 read_sizes(TomlTable& table, const char* key, const char* what) {
  if (!table.has(key)) {
    table.fail(fmt::format("needs '{}', {} [x, y, z]", key, what));
  }
  Vector3 sizes = table.vector(key).value_or(Vector3::Ones());
  if (!(sizes.minCoeff() > 0.0)) {
    table.fail(key, "expected three numbers > 0");
  }
  return sizes;
}

// With a radius and a length.
template <typename Shape>
Geometry read_round(TomlTable& table) {
  return Shape{table.required_number("radius", kPositive),
               table.required_number("length", kPositive)};
}

enum class ShapeName { plane, box, sphere, cylinder, capsule, cone, ellipsoid };

Geometry read_geometry(TomlTable& table, ShapeName shape) {
  switch (shape) {
    case ShapeName::plane:
      return PlaneGeometry{};
    case ShapeName::box:
      return BoxGeometry{read_sizes(table, "size", "the edges")};
    case ShapeName::sphere:
      return SphereGeometry{table.required_number("radius", kPositive)};
    case ShapeName::cylinder:
      return read_round<CylinderGeometry>(table);
    case ShapeName::capsule:
      return read_round<CapsuleGeometry>(table);
    case ShapeName::cone:
      return read_round<ConeGeometry>(table);
    case ShapeName::ellipsoid:
      break;
  }
  return EllipsoidGeometry{read_sizes(table, "radii", "along")};
}

// Which shapes have a key.
const std::map<std::string, std::vector<ShapeName>>& find_owners() {
  static const std::map<std::string, std::vector<ShapeName>> owners = {
      {"normal", {ShapeName::plane}},
      {"size", {ShapeName::box}},
      {"radius",
       {ShapeName::sphere, ShapeName::cylinder, ShapeName::capsule,
        ShapeName::cone}},
      {"length", {ShapeName::cylinder, ShapeName::capsule, ShapeName::cone}},
      {"radii", {ShapeName::ellipsoid}},
      {"orientation_rpy",
       {ShapeName::box, ShapeName::sphere, ShapeName::cylinder,
        ShapeName::capsule, ShapeName::cone, ShapeName::ellipsoid}}};
  return owners;
}

/// None, and a problem, without a known shape.
std::optional<ShapeName> read_shape_name(TomlTable& table) {
  static const std::vector<std::pair<std::string, std::optional<ShapeName>>>
      names = {
          {"plane", ShapeName::plane},        {"box", ShapeName::box},
          {"sphere", ShapeName::sphere},      {"cylinder", ShapeName::cylinder},
          {"capsule", ShapeName::capsule},    {"cone", ShapeName::cone},
          {"ellipsoid", ShapeName::ellipsoid}};
  if (!table.has("shape")) {
    table.fail(
        "needs 'shape', 'plane', 'box', 'sphere', 'cylinder', 'capsule', "
        "'cone' or 'ellipsoid'");
  }
  const auto shape =
      read_choice<std::optional<ShapeName>>(table, "shape", names, {});
  for (const auto& [key, shapes] : find_owners()) {
    if (!table.has(key)) continue;
    table.skip(key);
    if (!shape ||
        std::find(shapes.begin(), shapes.end(), *shape) != shapes.end()) {
      continue;
    }
    const char* article = *shape == ShapeName::ellipsoid ? "an" : "a";
    table.fail(key, fmt::format("does not apply to {} {}; leave it out",
                                article, *table.text("shape")));
  }
  return shape;
}

}  // namespace

BodyStart read_body_start(TomlTable& table) {
  BodyStart start;
  start.position = table.vector("position").value_or(Vector3::Zero());
  start.orientation_rpy =
      table.vector("orientation_rpy").value_or(Vector3::Zero());
  start.velocity = table.vector("velocity").value_or(Vector3::Zero());
  start.angular_velocity =
      table.vector("angular_velocity").value_or(Vector3::Zero());
  return start;
}

std::optional<RobotBase> read_base(TomlTable& table) {
  return read_choice<std::optional<RobotBase>>(
      table, "base", {{"free", RobotBase::free}, {"fixed", RobotBase::fixed}},
      {});
}

JointModel read_joint_model(TomlTable& table) {
  return read_choice<JointModel>(
      table, "joint",
      {{"stiff", JointModel::stiff}, {"ideal", JointModel::ideal}},
      JointModel::stiff);
}

RobotSpec read_placed_robot(TomlTable& table,
                            const std::filesystem::path& folder) {
  RobotSpec robot;
  robot.name = table.required_text("name");
  // The name goes before a dot, and patterns stand for what has a wildcard.
  if (table.has("name") &&
      (robot.name.empty() || robot.name == "world" ||
       robot.name.find_first_of(".*?/") != std::string::npos)) {
    table.fail("name", fmt::format("'{}' cannot name a robot; use a text "
                                   "without '.', '*', '?' and '/', not 'world'",
                                   echo(robot.name)));
  }
  robot.file = (folder / table.required_text("file")).lexically_normal();
  robot.start = read_body_start(table);
  robot.base = read_base(table);
  robot.joint = read_joint_model(table);
  return robot;
}

ProjectileSpec read_projectile(TomlTable& table) {
  ProjectileSpec projectile;
  projectile.name = table.required_text("name");
  projectile.radius = table.required_number("radius", kPositive);
  projectile.mass = read_sphere_mass(table, projectile.radius);
  if (!table.has("position")) table.fail("needs 'position' of its centre");
  projectile.start = read_body_start(table);
  projectile.material = read_material(table);
  return projectile;
}

ObstacleSpec read_obstacle(TomlTable& table) {
  ObstacleSpec obstacle;
  obstacle.name = table.required_text("name");
  obstacle.X_WS.p = table.vector("position").value_or(Vector3::Zero());
  obstacle.material = read_material(table);
  if (!table.has("position")) table.fail("needs 'position'");
  const std::optional<ShapeName> shape = read_shape_name(table);
  if (!shape) return obstacle;
  obstacle.geometry = read_geometry(table, *shape);
  if (shape == ShapeName::plane) {
    obstacle.X_WS.R = read_normal(table);
    return obstacle;
  }
  obstacle.orientation_rpy =
      table.vector("orientation_rpy").value_or(Vector3::Zero());
  obstacle.X_WS.R = rotation_rpy(obstacle.orientation_rpy);
  return obstacle;
}

}  // namespace limber::scene
