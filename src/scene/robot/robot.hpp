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
#include "joints/bushing.hpp"
#include "joints/drive.hpp"
#include "joints/friction.hpp"
#include "joints/joint_kind.hpp"
#include "joints/point_spring.hpp"
#include "joints/scalar_spring.hpp"
#include "scene/place.hpp"

/// A robot as its URDF file and Limber's extension describe it. Plain
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

/// End stops of one coordinate; what is not given follows from the joint.
struct StopOptions {
  std::optional<double> lower;      ///< none: unbounded [rad or m]
  std::optional<double> upper;      ///< none: unbounded [rad or m]
  std::optional<double> stiffness;  ///< none: by mass [N m/rad or N/m]
  std::optional<double> damping;    ///< none: by restitution [s/rad or s/m]
  double restitution = 0.5;         ///< of a free body at `speed` [-]
  double speed = 1.0;               ///< [rad/s or m/s]
};

/// What acts along a coordinate of a joint: <stop>, <friction>, <spring>.
struct JointAction {
  int coordinate = 0;  ///< from 0
  std::variant<StopOptions, joints::Friction::Parameters,
               joints::ScalarSpring::Parameters>
      law;
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
  std::vector<JointAction> actions;
  /// Of drives: <limit>'s effort [N or N m] and velocity [m/s or rad/s].
  double max_effort = joints::Drive::kUnlimited;
  double max_speed = joints::Drive::kUnlimited;
};

/// One end of a coupler.
struct ConnectorEnd {
  Place where;                      ///< the link "world" is the world
  Matrix3 R = Matrix3::Identity();  ///< axes of the end in the link's
};

/// <loop>: a joint that closes a loop. Its frame is at the end `from`, at rest
/// where all joints of the tree are at zero.
struct Loop {
  std::string name;
  joints::JointKind kind = joints::JointKind::revolute;
  ConnectorEnd from;
  ConnectorEnd to;
  Vector3 axis_F = Vector3::UnitX();    ///< unit, axes of `from`
  Vector3 second_F = Vector3::UnitY();  ///< unit, of a universal joint
  CouplerOptions coupler;
  std::vector<JointAction> actions;
};

struct SpringOptions {
  joints::PointSpring::Parameters law;  ///< but for the free length
  std::optional<double> free_length;    ///< [m]; none: the length at the start
};

/// <spring> or <bushing>. A bushing is at rest at the start, in the axes of
/// `from`.
struct Connector {
  std::string name;
  ConnectorEnd from;
  ConnectorEnd to;
  std::variant<SpringOptions, joints::Bushing::Parameters> law;
};

/// <latch>: locks two ends that come near each other.
struct Latch {
  std::string name;
  ConnectorEnd from;
  ConnectorEnd to;
  CouplerOptions coupler;
  double reach = 0.0;                                ///< [m]
  double release_force = joints::Drive::kUnlimited;  ///< [N]
  double release_time = joints::Drive::kUnlimited;   ///< [s]
};

/// <tendon>: a line through two or more points that only pulls.
struct Tendon {
  std::string name;
  std::vector<ConnectorEnd> via;
  double stiffness = 0.0;             ///< [N/m]
  double damping = 0.0;               ///< [N s/m]
  std::optional<double> free_length;  ///< [m]; none: the length at the start
  std::optional<double> pretension;   ///< at the start [N]
  double tension = 0.0;               ///< constant, besides [N]
};

/// <gear> and URDF's <mimic>: q = ratio q_with + offset.
struct Gear {
  std::string name;
  std::string joint;                ///< of q, a joint or loop
  std::string with;                 ///< of q_with, a joint or loop
  double ratio = 1.0;               ///< not zero [unit of q / unit of q_with]
  double offset = 0.0;              ///< [unit of q]
  std::optional<double> stiffness;  ///< by q [N m/rad or N/m]
  std::optional<double> damping;    ///< by q [N m s/rad or N s/m]
};

/// A tree of links. Links are ordered so that a parent comes before its
/// children, and `joints[i]` leads to `links[i + 1]`.
struct Robot {
  std::string name;
  std::filesystem::path file;
  std::vector<Link> links;
  std::vector<Joint> joints;
  std::vector<Loop> loops;
  std::vector<Connector> connectors;
  std::vector<Latch> latches;
  std::vector<Tendon> tendons;
  std::vector<Gear> gears;
  std::vector<std::string> warnings;  ///< what was read but is not modelled

  /// Whether the root link stands for the world.
  [[nodiscard]] bool has_world_root() const {
    return !links.empty() && links.front().name == "world";
  }
};

/// Coordinates along which a kind's actions and drives act: 0 to 3.
[[nodiscard]] std::size_t count_coordinates(joints::JointKind kind);

/// All ends of a robot's couplers but those of its joints.
[[nodiscard]] std::vector<ConnectorEnd> find_ends(const Robot& robot);

/// Index of a link. @throws InputError naming the nearest.
[[nodiscard]] int find_link(const Robot& robot, const std::string& name);

}  // namespace limber::scene
