// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "limber/common/types.hpp"
#include "limber/contact/law/friction_memory.hpp"

namespace limber::contact {

/// The material point of a body at which a contact's force acted, which moves
/// with the nearest place of the surface; as numbers, see SurfacePlace.
struct PlaceMemory {
  Vector3 x_B = Vector3::Zero();  ///< undeformed, body frame [m]
  double face = -1.0;             ///< index [-]
  double u = 0.0;                 ///< [-]
  double v = 0.0;                 ///< [-]
};

/// Memory of a contact point between steps; all zero while it does not
/// touch.
struct PointMemory {
  /// Approach speed at first touch, 0 before it [m/s].
  double speed = 0.0;
  double time = 0.0;      ///< of the last commit [s]
  PlaceMemory on_A = {};  ///< at the last commit one point
  PlaceMemory on_B = {};
  FrictionMemory friction = {};

  [[nodiscard]] bool is_touching() const { return speed > 0.0; }
};

/// Number of values in a point's memory.
inline constexpr std::size_t kPointNumbers = 14 + kFrictionNumbers;

/// @param numbers kPointNumbers of them
[[nodiscard]] PointMemory load_memory(std::span<const double> numbers);
void save_memory(const PointMemory& memory, std::span<double> numbers);

}  // namespace limber::contact
