// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "limber/dynamics/equations/placed_drive.hpp"
#include "limber/dynamics/system/system_state.hpp"

namespace limber::dynamics {

/// Finds where drives reach and leave their effort limit within a step, and
/// where drives that only pull become slack or taut: there the rate of the
/// effort jumps, and schemes of second order lose an order.
///
/// Equation   the ratio of the effort before clipping to the limit, along the
///            cubic through a drive's coordinate and rate at both ends, with
///            the command at its own time
/// Limits     evaluated nine times a step, which is short relative to the
/// command's
///            period: a shorter stay is missed. Not for the speed limit of
///            effort drives, nor drives that only pull, without a limit.
class LimitCrossing {
 public:
  explicit LimitCrossing(const SystemModel& model);

  [[nodiscard]] bool is_empty() const { return drives_.empty(); }

  /// The first one, as a fraction of the step, not near its ends [-].
  /// @param before, after states at the step's ends
  [[nodiscard]] std::optional<double> find_first(
      const SystemState& before, const SystemState& after) const;

 private:
  const SystemModel& model_;
  std::vector<PlacedDrive> drives_;
};

}  // namespace limber::dynamics
