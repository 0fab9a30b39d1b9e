// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/dynamics/monitors/followed.hpp"
#include "limber/scene/probes/probe.hpp"

namespace limber::scene {

/// All columns of all probes, in order, for evaluation at every step. NaN where
/// a quantity is undefined. The place of a stress is the index of its point.
/// @param probes, model stored by reference
[[nodiscard]] dynamics::Followed follow(const std::vector<Probe>& probes,
                                        const dynamics::SystemModel& model);

}  // namespace limber::scene
