// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "limber/common/types.hpp"
#include "limber/contact/law/bristle_friction.hpp"

namespace limber::contact {

/// The material point of a body at which a contact's force acted, which moves
/// with the nearest place of the surface; as numbers, see SurfacePlace.
struct PlaceMemory {
  Vector3 x_B = Vector3::Zero();  ///< undeformed, body frame [m]
  double face = -1.0;             ///< index [-]
  double u = 0.0;                 ///< [-]
  double v = 0.0;                 ///< [-]
};

/// Rotation of body B in A, as a quaternion [-]; all zero if not yet set.
struct TurnMemory {
  double w = 0.0;
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;

  [[nodiscard]] bool is_set() const {
    return w != 0.0 || x != 0.0 || y != 0.0 || z != 0.0;
  }
  [[nodiscard]] Quaternion quat_AB() const { return {w, x, y, z}; }
};

/// Memory of a contact point between steps; all zero while it does not
/// touch.
struct PointMemory {
  /// Approach speed at first touch, 0 before it [m/s].
  double speed = 0.0;
  double tangential_stiffness = 0.0;  ///< k_t of that speed [N/m]
  double time = 0.0;                  ///< of the last commit [s]
  BristleMemory bristle = {};         ///< in the frame of body B
  PlaceMemory on_A = {};              ///< at the last commit one point
  PlaceMemory on_B = {};
  double twist = 0.0;    ///< of the bristle about the normal [rad]
  TurnMemory turn = {};  ///< at the last commit

  [[nodiscard]] bool is_touching() const { return speed > 0.0; }
};

/// Number of values in a point's memory.
inline constexpr std::size_t kPointNumbers = 26;

/// @param numbers kPointNumbers of them
[[nodiscard]] PointMemory load_memory(std::span<const double> numbers);
void save_memory(const PointMemory& memory, std::span<double> numbers);

}  // namespace limber::contact
