// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "limber/common/types.hpp"
#include "limber/dynamics/analysis/equilibrium.hpp"
#include "limber/dynamics/analysis/level_advice.hpp"
#include "limber/dynamics/control/pid_controller.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/system/fidelity.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/dynamics/system/time_function.hpp"
#include "limber/flexbody/model/full_body.hpp"
#include "limber/flexbody/model/recipe.hpp"
#include "limber/joints/joint_motion.hpp"
#include "limber/joints/scalar/drive.hpp"
#include "limber/scene/robot/place.hpp"
#include "limber/scene/robot/robot_options.hpp"
#include "limber/scene/scenario/contact_spec.hpp"

/// Contents of a scenario file. Plain values; docs/reference/scenario.md is the
/// manual page.
namespace limber::scene {

struct LoadSpec {
  std::string name;
  Place where;
  Vector3 force = Vector3::Zero();   ///< [N]
  Vector3 moment = Vector3::Zero();  ///< [N m]
  dynamics::LoadFrame frame = dynamics::LoadFrame::body;
  dynamics::TimeFunction time;
  /// A force file (scene/text/force_file.hpp) in place of all but name and
  /// link: forces on every node, mesh frame.
  std::filesystem::path nodal_forces;
};

enum class Quantity {
  displacement,      ///< from the initial position, world frame [m]
  position,          ///< world [m]
  velocity,          ///< world [m/s]
  rotation,          ///< rotation vector from the start, world frame [rad]
  angular_velocity,  ///< world frame [rad/s]
  deformation,       ///< elastic part, link frame [m]
};

/// A probe of a point of a link.
struct PointProbeSpec {
  Place where;
  Quantity quantity = Quantity::displacement;
  /// The motion is that in the frame of this place, in its link's axes, which
  /// rotate with it; not of `deformation`.
  std::optional<Place> relative_to;
};

/// Quantities of couplers; docs/reference/scenario.md lists those of each kind.
enum class CouplerQuantity {
  coordinate,                 ///< with full turns [rad or m]
  coordinate_rate,            ///< [rad/s or m/s]
  effort,                     ///< along each coordinate [N m or N]
  relative_position,          ///< from Fo to Mo [m]
  relative_rotation,          ///< rotation vector of M in F [rad]
  relative_velocity,          ///< rate of relative_position in F [m/s]
  relative_angular_velocity,  ///< of M in F [rad/s]
  force,                      ///< on one side [N]
  moment,                     ///< on one side, about its origin [N m]
  energy,                     ///< stored [J]
  dissipation,                ///< dissipated power [W]
  power,                      ///< supplied by its drives [W]
};
[[nodiscard]] inline bool has_side(CouplerQuantity quantity) {
  return quantity == CouplerQuantity::force ||
         quantity == CouplerQuantity::moment;
}
[[nodiscard]] inline bool is_vector(CouplerQuantity quantity) {
  return quantity >= CouplerQuantity::relative_position &&
         quantity <= CouplerQuantity::moment;
}
/// Frame of a coupler on which a force acts, and in which vectors are
/// expressed.
enum class ProbeSide { F, M };
enum class ProbeAxes { F, M, world };

/// A probe of a joint, spring, bushing, latch, tendon or gear.
struct CouplerProbeSpec {
  std::string coupler;
  CouplerQuantity quantity = CouplerQuantity::coordinate;
  ProbeSide side = ProbeSide::M;  ///< of force and moment
  ProbeAxes axes = ProbeAxes::F;  ///< of vectors
};

/// Quantities over all points where two bodies touch.
enum class ContactQuantity {
  force,           ///< resultant on the second body, world frame [N]
  normal_force,    ///< sum of magnitudes [N]
  friction_force,  ///< magnitude of the resultant [N]
  place,           ///< of the largest normal force, world; 0 while apart [m]
  depth,           ///< largest; while apart minus the distance [m]
  area,            ///< sum [m^2]
  energy,          ///< stored, sum [J]
  touching,        ///< 0 or 1
  slipping,        ///< 0 or 1: whether a point slips
};
[[nodiscard]] inline bool is_vector(ContactQuantity quantity) {
  return quantity == ContactQuantity::force ||
         quantity == ContactQuantity::place;
}

/// A probe of the contact between two bodies.
struct ContactProbeSpec {
  std::array<std::string, 2> bodies;  ///< links, projectiles or obstacles
  ContactQuantity quantity = ContactQuantity::force;
};

/// A probe of a controller's output.
struct ControllerProbeSpec {
  std::string controller;
};

/// Stress quantities at nodes of a flexible link.
enum class StressQuantity {
  stress,          ///< six components, link frame [Pa]
  von_mises,       ///< [Pa]
  max_principal,   ///< largest principal stress, tension positive [Pa]
  tsai_wu,         ///< failure index of a ply [-]
  maximum_stress,  ///< stress of a ply over its strength, the largest [-]
  section_force,   ///< of a beam: N, Vy, Vz [N], T, My, Mz [N m]
};

/// Whether it is a failure index.
[[nodiscard]] constexpr bool is_index(StressQuantity quantity) {
  return quantity == StressQuantity::tsai_wu ||
         quantity == StressQuantity::maximum_stress;
}

/// Through the thickness of a shell, or of the ply that is given.
enum class SectionLayer { all, bottom, middle, top };

/// Axes of components of stress: of the link, of a shell's ply or a beam's
/// section, or of the material, which for shells is the ply's.
enum class StressAxes { link, layer, material };

/// Where in the section of a beam or shell.
struct SectionSelection {
  SectionLayer layer = SectionLayer::all;
  int ply = 0;      ///< from 1 at the bottom; 0: all
  int element = 0;  ///< number of a beam; 0: all
  StressAxes axes = StressAxes::link;
};

/// A probe of stress at a node, or of the largest at several; without an
/// interface or selection of nodes, on the link's whole surface.
struct StressProbeSpec {
  Place where;
  StressQuantity quantity = StressQuantity::von_mises;
  SectionSelection section;
};

struct ProbeSpec {
  std::string name;
  std::variant<PointProbeSpec, CouplerProbeSpec, ContactProbeSpec,
               ControllerProbeSpec, StressProbeSpec>
      of;
};

/// Coordinates of one joint at the start.
using JointStart = joints::JointCoordinates;

/// Deformation of a flexible link at the start and its rate: by modal
/// coordinates, or by files of nodal fields (scene/text/force_file.hpp).
struct LinkStart {
  std::vector<double> eta;     ///< [kg^1/2 m]; those not given are zero
  std::vector<double> etadot;  ///< [kg^1/2 m/s]
  std::filesystem::path displacement;
  std::filesystem::path velocity;
};

/// Overrides of a link's <basis>; unset values are unchanged.
struct BasisChoice {
  std::optional<int>
      eigenmodes;  ///< number of lowest ones; also in place of "auto"
  std::optional<bool> interfaces;  ///< their static-deformation modes
  std::optional<bool> loads;       ///< their static-deformation modes
  std::optional<int> terms = {};   ///< number of Krylov terms for each of these
  std::optional<int> pieces = {};  ///< of its mesh; 0: by its slenderness

  bool operator==(const BasisChoice&) const = default;
};

/// A drive along a coordinate of a joint or loop, or along a tendon.
struct DriveSpec {
  std::string name;    ///< defaults to that of its joint or tendon
  std::string joint;   ///< a joint's or loop's name, or empty
  std::string tendon;  ///< a tendon's name, or empty
  int coordinate = 1;  ///< its number in the joint, from 1
  joints::Drive::Parameters drive;
};

/// A controller that loads and drives follow. Its place in
/// Scenario::controllers is the index of the input that it writes.
struct ControllerSpec {
  std::string name;
  std::string measures;  ///< a column of a probe: "tip.ux"
  std::string rate;      ///< the column of its rate; empty: by differences
  dynamics::PidParameters pid;
  double offset = 0.0;  ///< time of the first sample [s]
  dynamics::InputHold hold = dynamics::InputHold::held;
};

struct OutputSpec {
  std::filesystem::path folder;  ///< empty: out/<scenario name>
  bool xdmf = false;
  bool pictures = true;
  bool stress = false;  ///< of every flexible link, over its whole surface
  bool errors = false;  ///< of probes by cause, each from one more run
  double checkpoint_interval = 60.0;  ///< wall time, >= 0 [s]
};

struct Scenario {
  std::string name;  ///< the file's stem
  std::filesystem::path file;
  std::filesystem::path robot;  ///< its only one; empty if there are several
  std::optional<RobotBase> robot_base;  ///< none: as its file has it
  JointModel robot_joint = JointModel::stiff;
  std::vector<RobotSpec> robots;  ///< in its place
  RobotOptions urdf;              ///< how their files are read
  dynamics::SimulationSettings settings;
  dynamics::Fidelity fidelity = dynamics::Fidelity::coupled;
  std::map<std::string, dynamics::Fidelity> fidelity_of_link;
  flexbody::FullOptions full;  ///< of links at level `full`
  BasisChoice basis;           ///< of every flexible link
  std::map<std::string, BasisChoice> basis_of_link;  ///< over `basis`
  std::vector<LoadSpec> loads;
  Vector3 gravity = Vector3::Zero();  ///< [m/s^2]
  std::map<std::string, JointStart> joints;
  BodyStart base;  ///< of the root link of the only robot
  std::map<std::string, LinkStart> link_starts;
  /// Starts at rest from the static equilibrium near the above.
  std::optional<dynamics::EquilibriumMethod> equilibrium;
  std::vector<ProjectileSpec> projectiles;
  std::vector<ObstacleSpec> obstacles;
  std::vector<ContactSpec> contacts;
  std::vector<ControllerSpec> controllers;
  std::vector<DriveSpec> drives;
  std::map<std::string, double> releases;  ///< of latches, at these times [s]
  std::vector<ProbeSpec> probes;
  OutputSpec output;
  std::vector<std::string> warnings;  ///< deviations from the file's values
  std::vector<std::string> notes;     ///< notices for the user
  dynamics::AdviceSettings advice;    ///< what may be neglected

  [[nodiscard]] dynamics::Fidelity level_of(const std::string& link) const {
    const auto found = fidelity_of_link.find(link);
    return found == fidelity_of_link.end() ? fidelity : found->second;
  }
};

}  // namespace limber::scene
