// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include "limber/common/pose.hpp"
#include "limber/contact/law/materials.hpp"
#include "limber/scene/robot/geometry.hpp"

/// Added bodies and contacts of a scenario.
namespace limber::scene {

/// Motion of a free body at the start, world frame.
struct BodyStart {
  Vector3 position = Vector3::Zero();          ///< [m]
  Vector3 orientation_rpy = Vector3::Zero();   ///< [rad]
  Vector3 velocity = Vector3::Zero();          ///< of its origin [m/s]
  Vector3 angular_velocity = Vector3::Zero();  ///< [rad/s]
};

/// How a robot's root link is held at the start and after it.
enum class RobotBase { free, fixed };

/// Whether the constrained directions of a robot's joints deflect, where its
/// file does not tell: by default stiffnesses, or not.
enum class JointModel { stiff, ideal };

/// One of several robots.
struct RobotSpec {
  std::string name;
  std::filesystem::path file;          ///< URDF
  BodyStart start;                     ///< of its root link
  std::optional<RobotBase> base = {};  ///< none: as its file has it
  JointModel joint = JointModel::stiff;
};

/// A free rigid solid sphere; its origin is its centre.
struct ProjectileSpec {
  std::string name;
  double radius = 0.0;  ///< > 0 [m]
  double mass = 0.0;    ///< > 0 [kg]
  BodyStart start;
  /// None: rigid in contacts.
  std::optional<contact::SurfaceMaterial> material;
};

/// A shape that is fixed in the world.
struct ObstacleSpec {
  std::string name;
  Pose X_WS;  ///< of the shape's frame
  Geometry geometry;
  /// None: rigid.
  std::optional<contact::SurfaceMaterial> material;
  Vector3 orientation_rpy = Vector3::Zero();  ///< of X_WS, as given [rad]
};

/// Options of contacts; those not given follow from shapes and materials.
struct ContactOptions {
  std::optional<double> friction;          ///< of sliding, >= 0 [-]
  std::optional<double> static_friction;   ///< >= friction [-]
  std::optional<double> stribeck_speed;    ///< > 0 [m/s]
  std::optional<double> rolling_friction;  ///< arm, >= 0 [m]
  std::optional<double> restitution;       ///< in [0, 1] [-]
  std::optional<double> damping;           ///< in its place, >= 0 [s/m]
  std::optional<double> radius;            ///< R_e > 0 [m]
  std::optional<double> stiffness;         ///< Hertz's k > 0 [N/m^1.5]
};

/// Two bodies that may touch: names, or patterns with * and ?.
struct ContactSpec {
  std::array<std::string, 2> between;
  ContactOptions options;  ///< those of [contact_default] included
};

}  // namespace limber::scene
