// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/dynamics/system/system_model.hpp"

namespace limber::dynamics {

/// Checks a whole model, built or changed by hand: that it has bodies and they
/// have masses; names, indices, sizes of tables, offsets; that couplers join
/// two bodies, sums are of joints' coordinates and loads act on bodies.
/// @throws InputError listing all errors.
void check_model(const SystemModel& model);

/// A model with these controllers in place of its own. They may measure what
/// only a whole model tells. @throws InputError as check_model.
[[nodiscard]] SystemModel with_controllers(
    SystemModel model, std::vector<ControllerModel> controllers);

}  // namespace limber::dynamics
