// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "common/pose.hpp"
#include "dynamics/system_builder.hpp"
#include "flexbody/recipe.hpp"
#include "joints/joint_kind.hpp"

/// A robot as its URDF file and the <flexible> extension describe it. Plain
/// values; docs/formats/urdf.md is the manual page.
namespace limber::scene {

/// <inertial> of a rigid link, turned into the link's axes.
struct LinkInertia {
  double mass = 0.0;                  ///< [kg]
  Vector3 p_LBcm = Vector3::Zero();   ///< centre of mass in L [m]
  Matrix3 inertia = Matrix3::Zero();  ///< about it, axes of L [kg m^2]
};

/// What <flexible link="..."> adds to a link.
struct FlexibleLink {
  flexbody::MeshSource mesh;           ///< used if `reduced_file` is empty
  std::filesystem::path reduced_file;  ///< a saved reduced body
  Pose X_LM;                           ///< mesh frame in the link frame
  std::vector<flexbody::MaterialRegion> materials;
  dynamics::ModalDamping damping;
  flexbody::BasisOptions basis;
  flexbody::KeptRows rows;
  std::vector<std::string> clamped_groups;
  std::vector<flexbody::InterfaceRequest> interfaces;
  std::map<std::string, std::string> interface_of_joint;
};

struct Link {
  std::string name;
  std::optional<LinkInertia> inertia;
  std::optional<FlexibleLink> flexible;
};

/// What <coupler joint="..."> gives; the rest follows from the bodies.
struct CouplerOptions {
  std::optional<double> translational_stiffness;  ///< [N/m]
  std::optional<double> rotational_stiffness;     ///< [N m/rad]
  std::optional<double> translational_damping;    ///< [N s/m]
  std::optional<double> rotational_damping;       ///< [N m s/rad]
  std::optional<double> free_damping;             ///< [N s/m or N m s/rad]
};

struct Joint {
  std::string name;
  joints::JointKind kind = joints::JointKind::fixed;
  int parent = 0;  ///< link index
  int child = 0;   ///< link index
  Pose X_PJ;       ///< joint frame in the parent link's frame
  Vector3 axis_J = Vector3::UnitX();    ///< unit
  Vector3 second_J = Vector3::UnitY();  ///< unit, of a universal joint
  CouplerOptions coupler;
};

/// One end of a <spring> or <bushing>: the world, or a link and, if it is
/// flexible, one of its interfaces.
struct ConnectorEnd {
  std::string link;                 ///< "world" is the world
  std::string interface;            ///< of a flexible link
  Vector3 point = Vector3::Zero();  ///< in the link (or world) frame [m]
};

struct SpringOptions {
  double stiffness = 0.0;             ///< [N/m]
  double damping = 0.0;               ///< [N s/m]
  std::optional<double> free_length;  ///< [m]; none: the length at the start
};

/// Stiffness along and about the axes of the `from` link at the start.
struct BushingOptions {
  Vector3 translational_stiffness = Vector3::Zero();  ///< [N/m]
  Vector3 rotational_stiffness = Vector3::Zero();     ///< [N m/rad]
  Vector3 translational_damping = Vector3::Zero();    ///< [N s/m]
  Vector3 rotational_damping = Vector3::Zero();       ///< [N m s/rad]
};

struct Connector {
  std::string name;
  ConnectorEnd from;
  ConnectorEnd to;
  std::variant<SpringOptions, BushingOptions> law;
};

/// A tree of links. Links are ordered so that a parent comes before its
/// children, and `joints[i]` leads to `links[i + 1]`.
struct Robot {
  std::string name;
  std::filesystem::path file;
  std::vector<Link> links;
  std::vector<Joint> joints;
  std::vector<Connector> connectors;
  std::vector<std::string> warnings;  ///< what was read but is not modelled

  /// Whether the root link stands for the world.
  [[nodiscard]] bool has_world_root() const {
    return !links.empty() && links.front().name == "world";
  }
};

/// Index of a link. @throws InputError naming the nearest.
[[nodiscard]] int find_link(const Robot& robot, const std::string& name);

}  // namespace limber::scene
