// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/dynamics/system/system_state.hpp"

namespace limber::dynamics {

/// Bodies between which something acts, each once; kWorld is one like others.
using JoinedBodies = std::vector<BodyIndex>;
[[nodiscard]] JoinedBodies find_joined_bodies(const SystemModel& model,
                                              const Coupler& coupler);
[[nodiscard]] JoinedBodies find_joined_bodies(const SystemModel& model,
                                              const Transmission& transmission);
[[nodiscard]] JoinedBodies find_joined_bodies(const Pair& pair);

/// Kinetic energy of the motion of bodies relative to each other: the largest
/// energy that forces between them can absorb [J]. A common translation or
/// rotation, and other bodies, do not change it.
///
/// Equation   min over r of sum_b m |v_b - v_r - w_r x (p_b - p_r)|^2 / 2
///            + (w_b - w_r)' J (w_b - w_r) / 2 + |etadot_b|^2 / 2,
///            with one of them, r, as the reference: the world where it is
///            among them
/// Limits     a measure: of two free bodies it is at most 1 + m_light / m_heavy
///            times the energy about their common centre of mass. Of an
///            unreduced body, its BodyState alone (update_mean_frames).
[[nodiscard]] double find_relative_kinetic(const SystemModel& model,
                                           const SystemState& state,
                                           const JoinedBodies& bodies);

}  // namespace limber::dynamics
