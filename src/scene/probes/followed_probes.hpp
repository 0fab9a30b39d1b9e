// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "dynamics/followed.hpp"
#include "scene/probe.hpp"

namespace limber::scene {

/// All columns of all probes, in order, for a run to follow at every step.
/// Where a quantity has no meaning it is not a number.
/// @param probes, model kept by reference
[[nodiscard]] dynamics::Followed follow(const std::vector<Probe>& probes,
                                        const dynamics::SystemModel& model);

}  // namespace limber::scene
