// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "limber/common/types.hpp"
#include "limber/contact/law/bristle_friction.hpp"

namespace limber::contact {

/// The material point of a body at which a contact's force acted, moved as the
/// place of the surface next to it; as numbers, see SurfacePlace.
struct PlaceMemory {
  Vector3 x_B = Vector3::Zero();  ///< undeformed, body frame [m]
  double face = -1.0;             ///< index
  double u = 0.0;                 ///< [-]
  double v = 0.0;                 ///< [-]
};

/// What a contact's point remembers between steps; of a point that does not
/// touch all zero.
struct PointMemory {
  /// Approach at first touch, 0 before it [m/s].
  double speed = 0.0;
  double damping = 0.0;               ///< b of that speed [s/m]
  double tangential_stiffness = 0.0;  ///< k_t of that speed [N/m]
  double time = 0.0;                  ///< of the last commit [s]
  BristleMemory bristle = {};         ///< in the frame of body B
  PlaceMemory on_A = {};              ///< at the last commit one point
  PlaceMemory on_B = {};

  [[nodiscard]] bool is_touching() const { return speed > 0.0; }
};

/// Numbers that one point takes.
inline constexpr std::size_t kPointNumbers = 22;

/// @param numbers kPointNumbers of them
[[nodiscard]] PointMemory load_memory(std::span<const double> numbers);
void save_memory(const PointMemory& memory, std::span<double> numbers);

}  // namespace limber::contact
