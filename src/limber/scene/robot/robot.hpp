// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "limber/common/pose.hpp"
#include "limber/contact/law/materials.hpp"
#include "limber/dynamics/system/default_stiffness.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/flexbody/model/recipe.hpp"
#include "limber/joints/bushing.hpp"
#include "limber/joints/joint_kind.hpp"
#include "limber/joints/point_spring.hpp"
#include "limber/joints/scalar/drive.hpp"
#include "limber/joints/scalar/friction.hpp"
#include "limber/joints/scalar/scalar_spring.hpp"
#include "limber/scene/robot/geometry.hpp"
#include "limber/scene/robot/place.hpp"

/// A robot as described by its URDF file with Limber's extension. Plain values;
/// docs/reference/urdf.md is the manual page.
namespace limber::scene {

/// <inertial> of a rigid link, expressed in the link's axes.
struct LinkInertia {
  double mass = 0.0;                  ///< [kg]
  Vector3 p_LBcm = Vector3::Zero();   ///< centre of mass in L [m]
  Matrix3 inertia = Matrix3::Zero();  ///< about it, frame L [kg m^2]
  std::string place = {};             ///< "FILE:LINE" of it, for messages
};

/// Data of <flexible link="...">.
struct FlexibleLink {
  flexbody::MeshSource mesh;           ///< used if `reduced_file` is empty
  std::filesystem::path reduced_file;  ///< a saved reduced body
  Pose X_LM;                           ///< mesh frame in the link frame
  std::vector<flexbody::MaterialRegion> materials;
  double loss_factor = 0.0;        ///< of its material [-]
  dynamics::ModalDamping damping;  ///< of its modes alone
  flexbody::BasisOptions basis;
  flexbody::KeptRows rows;
  std::vector<std::string> clamped_groups;
  std::vector<flexbody::InterfaceRequest> interfaces;
  std::map<std::string, std::string> interface_of_joint;
  /// Groups whose surfaces the scenario's contacts need, "skin" for the whole.
  std::vector<std::string> contact_groups = {};
  int pieces = 1;  ///< bodies that the mesh is cut into; 0: by its slenderness
};

/// <collision> or <visual> of a rigid link.
struct Collision {
  Pose X_LS;  ///< shape's frame in the link's
  Geometry geometry;
};

/// <contact link="...">: properties of the link in contacts.
struct LinkContact {
  /// Of a rigid link; none: rigid also in contacts.
  std::optional<contact::SurfaceMaterial> material;
  /// Of a flexible link: the groups that touch; empty: its whole surface.
  std::vector<std::string> surfaces;
};

struct Link {
  std::string name;
  std::optional<LinkInertia> inertia;
  std::optional<FlexibleLink> flexible;
  std::vector<Collision> collisions = {};
  std::vector<Collision> visuals = {};  ///< for pictures alone
  LinkContact contact = {};
};

/// Options of <coupler joint="...">.
using dynamics::CouplerOptions;

/// End stops of one coordinate; defaults follow from the joint.
struct StopOptions {
  std::optional<double> lower;      ///< none: unbounded [rad or m]
  std::optional<double> upper;      ///< none: unbounded [rad or m]
  std::optional<double> stiffness;  ///< none: by mass [N m/rad or N/m]
  std::optional<double> damping;    ///< none: by restitution [s/rad or s/m]
  double restitution = 0.5;         ///< of a free body at `speed` [-]
  double speed = 1.0;               ///< [rad/s or m/s]
};

/// An element along a coordinate of a joint: <stop>, <friction>, <spring>.
struct JointAction {
  int coordinate = 0;  ///< its index, from 0
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
  Vector3 axis_J = Vector3::UnitX();    ///< unit [-]
  Vector3 second_J = Vector3::UnitY();  ///< unit, of a universal joint [-]
  CouplerOptions coupler;
  std::vector<JointAction> actions;
  /// Of drives: <limit>'s effort and velocity.
  double max_effort = joints::Drive::kUnlimited;  ///< [N or N m]
  double max_speed = joints::Drive::kUnlimited;   ///< [m/s or rad/s]
};

/// One end of a coupler.
struct ConnectorEnd {
  Place where;                      ///< the link "world" is the world
  Matrix3 R = Matrix3::Identity();  ///< axes of the end in the link's [-]
};

/// <loop>: a joint that closes a loop. Its frame is at the end `from`,
/// unstressed with all joints of the tree at zero.
struct Loop {
  std::string name;
  joints::JointKind kind = joints::JointKind::revolute;
  ConnectorEnd from;
  ConnectorEnd to;
  Vector3 axis_F = Vector3::UnitX();    ///< unit, axes of `from` [-]
  Vector3 second_F = Vector3::UnitY();  ///< unit, of a universal joint [-]
  CouplerOptions coupler;
  std::vector<JointAction> actions;
};

struct SpringOptions {
  joints::PointSpring::Parameters law;  ///< except the free length
  std::optional<double> free_length;    ///< [m]; none: the length at the start
};

/// <spring> or <bushing>. A bushing is unstressed at the start, with the axes
/// of `from`.
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
  double tension = 0.0;               ///< additional, constant [N]
};

/// <gear> and URDF's <mimic>: q = ratio q_with + offset.
struct Gear {
  std::string name;
  std::string joint;                ///< of q, a joint or loop
  std::string with;                 ///< of q_with, a joint or loop
  double ratio = 1.0;               ///< not zero [unit of q / unit of q_with]
  double offset = 0.0;              ///< [unit of q]
  std::optional<double> stiffness;  ///< in terms of q [N m/rad or N/m]
  std::optional<double> damping;    ///< in terms of q [N m s/rad or N s/m]
};

/// A tree of links. Links are ordered so that a parent comes before its
/// children, and `joints[i]` leads to `links[i + 1]`. Links after those are
/// free bodies that a scenario adds.
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
  std::vector<std::string> warnings;  ///< content that is not modelled

  /// Whether the root link is the world.
  [[nodiscard]] bool has_world_root() const {
    return !links.empty() && links.front().name == "world";
  }
  /// Number of links of the tree.
  [[nodiscard]] std::size_t tree_size() const { return joints.size() + 1; }
};

/// Number of coordinates for a kind's actions and drives: 0 to 3.
[[nodiscard]] std::size_t count_coordinates(joints::JointKind kind);

/// All ends of a robot's couplers except those of its joints.
[[nodiscard]] std::vector<ConnectorEnd> find_ends(const Robot& robot);

/// The surfaces of a flexible link that may touch: groups, or "skin" for the
/// whole.
[[nodiscard]] std::vector<std::string> find_surfaces(const Link& link);

/// Index of a link. @throws InputError naming the nearest.
[[nodiscard]] int find_link(const Robot& robot, const std::string& name);

/// Whether a joint merges two rigid links into one body.
[[nodiscard]] bool merges(const Robot& robot, const Joint& joint);

}  // namespace limber::scene
