// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>

#include "limber/common/types.hpp"
#include "limber/contact/law/friction_memory.hpp"

namespace limber::contact {

/// Memory of a patch's friction since the last accepted step.
struct PatchMemory {
  bool is_touching = false;
  double time = 0.0;  ///< of the last step's end [s]
  /// Material points of both bodies that were at one place then [m].
  Vector3 x_A = Vector3::Zero();
  Vector3 x_B = Vector3::Zero();
  FrictionMemory friction;
};

inline constexpr std::size_t kPatchNumbers = 8 + kFrictionNumbers;

/// Of one of several patches.
[[nodiscard]] inline std::span<const double> find_slot(
    std::span<const double> memory, std::size_t index) {
  return memory.subspan(index * kPatchNumbers, kPatchNumbers);
}
[[nodiscard]] inline std::span<double> find_slot(std::span<double> memory,
                                                 std::size_t index) {
  return memory.subspan(index * kPatchNumbers, kPatchNumbers);
}

[[nodiscard]] inline bool is_touching(std::span<const double> slot) {
  return slot[0] != 0.0;
}
[[nodiscard]] PatchMemory load_patch(std::span<const double> memory);
/// @param memory of kPatchNumbers at least
void save_patch(const PatchMemory& patch, std::span<double> memory);

}  // namespace limber::contact
