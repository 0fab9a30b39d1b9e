// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "limber/common/types.hpp"

namespace limber::scene {

/// A point where an edge of one triangle passes through another that shares no
/// corner with it, if any. Triangles that touch in a common plane do not count.
///
/// Source     intersection of edge and triangle [@moller1997]
[[nodiscard]] std::optional<Vector3> find_self_crossing(
    const std::vector<Vector3>& points,
    const std::vector<std::array<int, 3>>& faces);

}  // namespace limber::scene
