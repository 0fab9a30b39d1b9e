// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "limber/dynamics/system/system_model.hpp"

namespace limber::dynamics {

/// The model with stiff joints in place of ideal ones, for analyses whose
/// unknowns are positions alone; none if it has no ideal joint. Deflections
/// differ by about 1 / (kIdealRatio kStiffnessRatio) of those of the stiffer
/// side, where the stiffness is a default.
[[nodiscard]] std::optional<SystemModel> replace_ideal_joints(
    const SystemModel& model);

}  // namespace limber::dynamics
