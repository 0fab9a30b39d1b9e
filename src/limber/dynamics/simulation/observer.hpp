// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "limber/dynamics/system/system_state.hpp"
#include "limber/dynamics/terms/energy_balance.hpp"

namespace limber::dynamics {

/// Called at every output time with the state and its energy balance.
using Observer = std::function<void(const SystemState&, const EnergyBalance&)>;

}  // namespace limber::dynamics
