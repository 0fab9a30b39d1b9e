// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "limber/common/material/section_regions.hpp"
#include "limber/common/material/solid_material.hpp"
#include "limber/common/types.hpp"
#include "limber/flexbody/model/full_body.hpp"
#include "limber/flexbody/model/node_selection.hpp"

/// Specification of one flexible body, before any mesh is read. Plain values,
/// hashed for the key of the cache, so everything that determines the result is
/// here.
namespace limber::flexbody {

using Material = SolidMaterial;

/// A material on one physical volume group; an empty group name means every
/// element that no other region covers.
struct MaterialRegion {
  std::string group;
  Material material;
};

/// Shells and beams on groups of a mesh, with their materials, which are those
/// of its solids, too.
struct SectionSource {
  std::vector<ShellRegion> shells;
  std::vector<BeamRegion> beams;
  std::vector<MaterialRegion> materials;

  [[nodiscard]] bool empty() const { return shells.empty() && beams.empty(); }
};

/// A finite-element model given by its matrices, in place of a mesh.
struct MatrixSource {
  std::vector<std::filesystem::path>
      paths;          ///< a folder, or files; empty: none
  double mass = 0.0;  ///< of the whole model, to check its unit, > 0 [kg]
  /// Recovery rows of a superelement and their points, unless `paths` have
  /// them.
  std::vector<std::filesystem::path> recovery = {};
};

/// Where the mesh comes from.
struct MeshSource {
  std::filesystem::path file;  ///< .msh, .geo or .step/.stp
  double size = 0.0;  ///< target element size [mesh units]; 0: the file's
  int order = 0;      ///< 1 to 3 when meshing geometry; 0: the file's, or 2 [-]
  double unit = 0.0;  ///< metres per mesh unit [m]; 0: the file's, or 1
  /// With paths, the body is of these matrices: `file` is their first path, and
  /// the recipe has no material. Forces are in N, times in s, masses so in
  /// N s^2 per `unit`.
  MatrixSource matrices = {};
  double force = 0.0;  ///< newtons per unit of force of a deck; 0: not stated
  std::vector<std::string> ignored = {};  ///< cards of a deck left out
  SectionSource sections = {};  ///< empty: the mesh is of solids, or a deck

  [[nodiscard]] bool is_matrices() const { return !matrices.paths.empty(); }
};

/// Weights of a selection's nodes in a load or an average.
enum class Weighting {
  uniform,  ///< by the area (or volume) of each node
  equal,    ///< every node the same
};

/// A named set of weighted nodes whose mean motion couplers, loads and probes
/// use. Names are unique within a body.
struct InterfaceRequest {
  std::string name;
  NodeSelection nodes;
  Weighting weighting = Weighting::uniform;
  /// Whether its six (or three) static-deformation modes enter the basis.
  bool static_modes = true;
};

/// A load on an interface: its static-deformation mode enters the basis, and
/// it is a load case of automatic modes. Only its direction matters.
struct LoadPattern {
  std::string interface;
  Vector3 force = Vector3::Zero();   ///< mesh frame [N]
  Vector3 moment = Vector3::Zero();  ///< mesh frame [N m]
  bool static_mode = true;           ///< false: only a load case
};

/// Forces on every node: the static responses to their span enter the basis,
/// and their columns are load cases of automatic modes. Rows: x, y, z of each
/// node that is not clamped, in the order of the mesh's tags.
struct NodalForces {
  std::string name;           ///< for messages
  std::vector<double> times;  ///< one per column, from which it applies [s]
  MatrixX forces;             ///< 3 x free nodes, cases [N]
};

/// A field on every node, rows as those of NodalForces; empty: no field.
struct NodalField {
  std::string name;  ///< for messages
  VectorX values;    ///< 3 x free nodes [m or m/s]
};

/// Measure of a mode's fraction of a load case; docs/theory/choosing.md.
enum class ModeMeasure {
  compliance,  ///< work of the load on the mode's static response
  report,      ///< the report's effective mass, which needs all modes
  mass,        ///< effective modal mass in x, y, z of a clamped body's base
};

[[nodiscard]] std::string_view to_string(ModeMeasure measure);
/// @throws InputError naming the nearest.
[[nodiscard]] ModeMeasure parse_measure(std::string_view name);

/// An impact that the body is likely to suffer: of another body of `mass`,
/// both rigid, by Hertz's law.
struct ExpectedImpact {
  double mass = 0.0;       ///< of the other body, > 0, or infinite [kg]
  double stiffness = 0.0;  ///< k of f = k d^(3/2), > 0 [N/m^(3/2)]
  double speed = 0.0;      ///< of approach, > 0 [m/s]
};

/// Selects those of the lowest eigenmodes that reach a fraction of every load
/// case. The load cases are the recipe's load patterns and nodal forces; if it
/// has neither, the forces and moments that its interfaces can carry. Of
/// impacts, all modes until two periods of the highest fit into their duration.
struct AutomaticModes {
  double threshold = 0.9;  ///< of the total of all modes, in [0, 1] [-]
  ModeMeasure measure = ModeMeasure::compliance;
  int candidates = 60;  ///< number of lowest elastic eigenmodes to select from
  std::vector<ExpectedImpact> impacts = {};  ///< of the scene
};

struct BasisOptions {
  int eigenmodes = 10;  ///< number of lowest elastic eigenmodes
  std::optional<AutomaticModes> automatic;  ///< in place of `eigenmodes`
  bool interface_modes = true;  ///< static-deformation modes: interfaces
  bool load_modes = true;       ///< static-deformation modes: loads
  int terms =
      1;  ///< number for each of these; above 1 Krylov terms (K^+ M)^n x_0
  double drop_tolerance = 1e-8;  ///< relative M-norm below which a vector
                                 ///< counts as dependent [-]
};

/// Which nodal rows of the basis are stored. Those of interfaces always are.
struct KeptRows {
  enum class Extent { all, boundary, groups };
  Extent extent = Extent::boundary;
  std::vector<std::string>
      groups;  ///< with Extent::groups: these groups' nodes

  bool operator==(const KeptRows&) const = default;
};

/// "all", "boundary", "interfaces" (nothing else), or names of groups.
[[nodiscard]] KeptRows parse_rows(const std::vector<std::string>& names);

struct Recipe {
  std::string name;
  MeshSource mesh;
  std::vector<MaterialRegion> materials;
  std::vector<std::string>
      clamped_groups;  ///< fixed to the world; may be empty
  std::vector<InterfaceRequest> interfaces;
  std::vector<LoadPattern> load_patterns;
  std::vector<NodalForces> nodal_forces;
  NodalField initial_displacement;  ///< projected before rows are discarded [m]
  NodalField initial_velocity;      ///< [m/s]
  BasisOptions basis;
  KeptRows rows;
  /// Surface groups that may touch other bodies, "skin" for the whole boundary;
  /// each becomes a ContactSurface.
  std::vector<std::string> contact_groups;
  bool manifold = false;  ///< with second-order kinematics, for level nonlinear
  MaterialLaw law = MaterialLaw::st_venant_kirchhoff;  ///< of the manifold
  bool stress = false;  ///< with stress modes at the stored rows
  /// Only what compares it with its pieces: the lowest frequencies and the
  /// flexibility at and between its interfaces to some 1e-4, by few solutions.
  bool is_estimate = false;
};

}  // namespace limber::flexbody
