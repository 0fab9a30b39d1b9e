// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "common/types.hpp"
#include "dynamics/equilibrium.hpp"
#include "dynamics/fidelity.hpp"
#include "dynamics/level_advice.hpp"
#include "dynamics/simulation.hpp"
#include "dynamics/system_builder.hpp"
#include "dynamics/time_function.hpp"
#include "flexbody/full_body.hpp"
#include "flexbody/recipe.hpp"
#include "joints/drive.hpp"
#include "scene/place.hpp"

/// What a scenario file asks for. Plain values; docs/formats/scenario.md is
/// the manual page.
namespace limber::scene {

struct LoadSpec {
  std::string name;
  Place where;
  Vector3 force = Vector3::Zero();   ///< [N]
  Vector3 moment = Vector3::Zero();  ///< [N m]
  dynamics::LoadFrame frame = dynamics::LoadFrame::body;
  dynamics::TimeFunction time;
  /// A force file (scene/force_file.hpp) in place of all but name and link:
  /// forces on every node, axes of the mesh.
  std::filesystem::path nodal_forces;
};

enum class Quantity {
  displacement,      ///< from the initial position, world axes [m]
  position,          ///< world [m]
  velocity,          ///< world [m/s]
  rotation,          ///< rotation vector from the start, world axes [rad]
  angular_velocity,  ///< world axes [rad/s]
  deformation,       ///< elastic part, axes of the link [m]
};

/// A point of a link that is followed.
struct PointProbeSpec {
  Place where;
  Quantity quantity = Quantity::displacement;
};

/// Of a coupler: docs/formats/scenario.md says which has what.
enum class CouplerQuantity {
  coordinate,                 ///< with whole turns [rad or m]
  coordinate_rate,            ///< [rad/s or m/s]
  effort,                     ///< along each coordinate [N m or N]
  relative_position,          ///< from Fo to Mo [m]
  relative_rotation,          ///< rotation vector of M in F [rad]
  relative_velocity,          ///< rate of relative_position in F [m/s]
  relative_angular_velocity,  ///< of M in F [rad/s]
  force,                      ///< on one side [N]
  moment,                     ///< on one side, about its origin [N m]
  energy,                     ///< stored [J]
  dissipation,                ///< power turned to heat [W]
  power,                      ///< that its drives put in [W]
};
[[nodiscard]] inline bool has_side(CouplerQuantity quantity) {
  return quantity == CouplerQuantity::force ||
         quantity == CouplerQuantity::moment;
}
[[nodiscard]] inline bool is_vector(CouplerQuantity quantity) {
  return quantity >= CouplerQuantity::relative_position &&
         quantity <= CouplerQuantity::moment;
}
/// On which of a coupler's frames a force acts, and whose axes are used.
enum class ProbeSide { F, M };
enum class ProbeAxes { F, M, world };

/// A joint, spring, bushing, latch, tendon or gear that is followed.
struct CouplerProbeSpec {
  std::string coupler;
  CouplerQuantity quantity = CouplerQuantity::coordinate;
  ProbeSide side = ProbeSide::M;  ///< of force and moment
  ProbeAxes axes = ProbeAxes::F;  ///< of vectors
};

struct ProbeSpec {
  std::string name;
  std::variant<PointProbeSpec, CouplerProbeSpec> of;
};

/// Coordinates of one joint: 1 (revolute, continuous, prismatic), 3 (planar:
/// x, y, angle) or 6 (floating: x, y, z, roll, pitch, yaw).
struct JointStart {
  std::vector<double> position;  ///< [m, rad]; empty: zero
  std::vector<double> velocity;  ///< [m/s, rad/s]; empty: zero
};

/// Deformation of a flexible link at the start and its rate: by modal
/// coordinates, or by files of nodal fields (scene/force_file.hpp).
struct LinkStart {
  std::vector<double> eta;     ///< [kg^1/2 m]; those not given are zero
  std::vector<double> etadot;  ///< [kg^1/2 m/s]
  std::filesystem::path displacement;
  std::filesystem::path velocity;
};

/// Motion of the root link at the start, world axes.
struct BaseStart {
  Vector3 position = Vector3::Zero();          ///< [m]
  Vector3 orientation_rpy = Vector3::Zero();   ///< [rad]
  Vector3 velocity = Vector3::Zero();          ///< of its origin [m/s]
  Vector3 angular_velocity = Vector3::Zero();  ///< [rad/s]
};

/// What takes the place of a link's <basis>; what is not given stays as it is.
struct BasisChoice {
  std::optional<int> eigenmodes;   ///< lowest; also in place of "auto"
  std::optional<bool> interfaces;  ///< their static-deformation modes
  std::optional<bool> loads;       ///< their static-deformation modes
  std::optional<int> terms = {};   ///< of each of these: Krylov terms

  bool operator==(const BasisChoice&) const = default;
};

/// A drive along a coordinate of a joint or loop, or along a tendon.
struct DriveSpec {
  std::string name;    ///< that of its joint or tendon if it has none
  std::string joint;   ///< a joint's or loop's name, or empty
  std::string tendon;  ///< a tendon's name, or empty
  int coordinate = 1;  ///< of the joint: 1, 2, ...
  joints::Drive::Parameters drive;
};

struct OutputSpec {
  std::filesystem::path folder;  ///< empty: out/<scenario name>
  bool xdmf = false;
  bool pictures = true;
  double checkpoint_interval = 60.0;  ///< of wall time, >= 0 [s]
};

struct Scenario {
  std::string name;  ///< the file's stem
  std::filesystem::path file;
  std::filesystem::path robot;
  dynamics::SimulationSettings settings;
  dynamics::Fidelity fidelity = dynamics::Fidelity::coupled;
  std::map<std::string, dynamics::Fidelity> fidelity_of_link;
  flexbody::FullOptions full;  ///< of links at level `full`
  BasisChoice basis;           ///< of every flexible link
  std::map<std::string, BasisChoice> basis_of_link;  ///< over `basis`
  std::vector<LoadSpec> loads;
  Vector3 gravity = Vector3::Zero();  ///< [m/s^2]
  std::map<std::string, JointStart> joints;
  BaseStart base;
  std::map<std::string, LinkStart> link_starts;
  /// Starts from the static equilibrium near what all these say, at rest.
  std::optional<dynamics::EquilibriumMethod> equilibrium;
  std::vector<DriveSpec> drives;
  std::map<std::string, double> releases;  ///< of latches, at these times [s]
  std::vector<ProbeSpec> probes;
  OutputSpec output;
  std::vector<std::string> warnings;  ///< what was read, but not to the letter
  dynamics::AdviceSettings advice;    ///< what may be neglected

  [[nodiscard]] dynamics::Fidelity level_of(const std::string& link) const {
    const auto found = fidelity_of_link.find(link);
    return found == fidelity_of_link.end() ? fidelity : found->second;
  }
};

}  // namespace limber::scene
