// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "limber/app/console/json.hpp"
#include "limber/common/progress.hpp"
#include "limber/flexbody/model/recipe.hpp"
#include "limber/results/pictures.hpp"

/// Requests and results of `limber operate`: steady states of one body.
namespace limber::app {

enum class OperatingKind { accelerating, drifting, spinning, driven_spin };
/// "accelerating", "drifting", "spinning", "driven-spin".
[[nodiscard]] const std::vector<std::string>& operating_kind_names();
/// @throws InputError naming the nearest.
[[nodiscard]] OperatingKind parse_operating_kind(const std::string& name);

/// A force spread evenly over a physical group.
struct GroupLoad {
  std::string group;
  Vector3 force = Vector3::Zero();  ///< mesh frame [N]
};

struct OperatingRequest {
  OperatingKind kind = OperatingKind::accelerating;
  std::vector<GroupLoad> loads;
  Vector3 axis = Vector3::Zero();   ///< of a spin; zero: none is given [-]
  Vector3 point = Vector3::Zero();  ///< that it passes through [m]
  double speed = 0.0;               ///< of a spin [rad/s]
  double drag_rate = 0.0;           ///< Rayleigh's alpha [1/s]
  double surface_drag = 0.0;        ///< per speed and area [N s/m^3]
  /// Of a drift: time after rest [s]; none: the limit.
  std::optional<double> after = {};
};

/// Key figures of a flexbody::OperatingState, and its fields.
struct OperatingAnswer {
  Json figures;
  std::vector<std::size_t> tags;  ///< Gmsh node tags
  results::Surface surface;       ///< all nodes, undeformed
  Matrix3X u;                     ///< 3 x N [m]
  Matrix3X internal_force;        ///< 3 x N [N]
  /// Tags of the nodes of `stress`; a node at a border of materials has a
  /// column for each material.
  std::vector<std::size_t> stress_tags;
  Matrix6X stress;    ///< 6 x p, mesh frame: xx, yy, zz, xy, yz, xz [Pa]
  double size = 0.0;  ///< the mesh's longest edge [m]
  std::string trust;  ///< a warning if linear theory is doubtful
  std::vector<std::string> notices;  ///< of the mesh
};

/// @throws InputError for a request that does not fit its kind, and as the
/// functions of reduction/operating_states.hpp.
[[nodiscard]] OperatingAnswer find_operating_state(
    const flexbody::Recipe& recipe, const OperatingRequest& request,
    const Progress& progress);

}  // namespace limber::app
