// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "limber/contact/patches/contact_side.hpp"
#include "limber/dynamics/system/system_model.hpp"
#include "limber/dynamics/system/system_state.hpp"

namespace limber::scene {

/// Two shapes on the bodies of a pair of a system.
struct PlacedPair {
  std::string name;
  double most_overlap = 0.0;  ///< largest at the start [m]
  std::size_t touching = 0;   ///< index of the bodies into Scene::touching
  dynamics::PairIndex pair = {};
};

/// 3 % of R_e with a ball, else 1 % of the smaller shape's size
/// (contact::find_size) [m].
[[nodiscard]] double find_most_overlap(const contact::ContactSide& A,
                                       const contact::ContactSide& B,
                                       const std::optional<double>& radius);

/// Refuses bodies that overlap at the start by more than that, since they would
/// burst apart.
/// @returns a notice of each smaller overlap, with its initial
/// force
/// @throws InputError listing such pairs, with depth and place (10 at most).
[[nodiscard]] std::vector<std::string> check_overlaps(
    const std::vector<PlacedPair>& pairs, const dynamics::SystemModel& model,
    const dynamics::SystemState& state);

}  // namespace limber::scene
