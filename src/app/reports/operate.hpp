// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/json.hpp"
#include "common/progress.hpp"
#include "flexbody/recipe.hpp"
#include "results/pictures.hpp"

/// What `limber operate` asks and answers: steady states of one body.
namespace limber::app {

enum class OperatingKind { accelerating, drifting, spinning, driven_spin };
/// "accelerating", "drifting", "spinning", "driven-spin".
[[nodiscard]] const std::vector<std::string>& operating_kind_names();
/// @throws InputError naming the nearest.
[[nodiscard]] OperatingKind parse_operating_kind(const std::string& name);

/// A force spread evenly over a physical group.
struct GroupLoad {
  std::string group;
  Vector3 force = Vector3::Zero();  ///< mesh axes [N]
};

struct OperatingRequest {
  OperatingKind kind = OperatingKind::accelerating;
  std::vector<GroupLoad> loads;
  Vector3 axis = Vector3::Zero();   ///< of a spin; zero: none is given
  Vector3 point = Vector3::Zero();  ///< that it passes through [m]
  double speed = 0.0;               ///< of a spin [rad/s]
  double drag_rate = 0.0;           ///< Rayleigh's alpha [1/s]
  double surface_drag = 0.0;        ///< a speed and area [N s/m^3]
  /// Of a drift: so long after it was at rest [s]; none: for ever.
  std::optional<double> after = {};
};

/// A flexbody::OperatingState in figures, and its fields.
struct OperatingAnswer {
  Json figures;
  std::vector<std::size_t> tags;
  results::Surface surface;  ///< all nodes, undeformed
  Matrix3X u;                ///< 3 x N [m]
  Matrix3X internal_force;   ///< 3 x N [N]
  double size = 0.0;         ///< the mesh's longest edge [m]
  std::string trust;         ///< a warning if linear theory is stretched
  std::vector<std::string> notices;  ///< of the mesh
};

/// @throws InputError for a request that does not go with its kind, and as the
/// functions of flexbody/fem_operating_state.hpp.
[[nodiscard]] OperatingAnswer find_operating_state(
    const flexbody::Recipe& recipe, const OperatingRequest& request,
    const Progress& progress);

}  // namespace limber::app
