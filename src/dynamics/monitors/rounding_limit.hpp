// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "limber/dynamics/system/system_state.hpp"

namespace limber::dynamics {

/// Positions in the world are rounded to 2^-52 of the distance from its origin,
/// and joints and contacts act on differences of them: far from the origin,
/// rounding looks like motion.
///
/// Equation   r = 2^-52 |p_WB| against the body's largest radius of gyration k.
///            Small deformations are a thousandth of k: r = 1e-7 k is a
///            ten-thousandth of them.

/// Warning if a body's position is rounded to more than 1e-7 of its size;
/// nothing if none is.
[[nodiscard]] std::optional<std::string> describe_rounding(
    const SystemModel& model, const SystemState& state);

/// Adds that warning, if there is one. @returns whether there is
bool add_rounding_warning(const SystemModel& model, const SystemState& state,
                          std::vector<std::string>& warnings);

/// @throws InputError naming the body if its position is rounded to more than
/// 1e-4 of its size
void check_rounding(const SystemModel& model, const SystemState& state);

}  // namespace limber::dynamics
