// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/analysis/principal_basis.hpp"
#include "limber/dynamics/analysis/steady_motion.hpp"

namespace limber::dynamics {

/// Small motion about a motion that should be steady, in the axes in which it
/// is most nearly so.
struct SteadyMotion {
  TurningAxes axes;
  SmallMotion motion;  ///< without frames: GroupMotion
  PrincipalBasis basis;
  /// Relative change of M, D and S while the system rotates by 1 rad [-].
  double change = 0.0;
};

/// In fixed axes, or in axes that rotate with the fastest spinning body,
/// whichever change less.
/// @throws InputError for a body at level `full`.
[[nodiscard]] SteadyMotion linearise_steadily(const SystemModel& model,
                                              const SystemState& state);

/// Each linked group that has coordinates by itself, in its own axes.
/// @throws InputError for a body at level `full`.
[[nodiscard]] std::vector<SteadyMotion> linearise_groups(
    const SystemModel& model, const SystemState& state);

}  // namespace limber::dynamics
