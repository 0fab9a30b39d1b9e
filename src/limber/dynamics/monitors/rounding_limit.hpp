// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/common/records/archive.hpp"
#include "limber/dynamics/system/system_state.hpp"

namespace limber::dynamics {

/// Positions in the world are rounded to 2^-52 of the distance from its origin,
/// and joints and contacts act on differences of them: far from the origin,
/// rounding looks like motion.
///
/// Equation   r = 2^-52 |p_WB| against the body's largest radius of gyration k.
///            Small deformations are a thousandth of k: r = 1e-7 k is a
///            ten-thousandth of them.

class RoundingLimit {
 public:
  explicit RoundingLimit(const SystemModel& model);

  /// Adds a warning, once, if a body's position is rounded to more than 1e-7 of
  /// its size. @param state with frames of unreduced bodies at their nodes
  void check(const SystemState& state, std::vector<std::string>& warnings);

  /// Saves or restores whether it was reported, for checkpoints.
  void exchange_memory(Archive& archive);

 private:
  const SystemModel& model_;
  std::vector<double> radii_;  // of gyration [m]
  bool was_reported_ = false;
};

/// @throws InputError naming the body if its position is rounded to more than
/// 1e-4 of its size
void check_rounding(const SystemModel& model, const SystemState& state);

}  // namespace limber::dynamics
