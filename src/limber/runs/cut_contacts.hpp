// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/dynamics/monitors/contact_record.hpp"
#include "limber/dynamics/system/system_model.hpp"
#include "limber/scene/robot/robot.hpp"

namespace limber::runs {

/// A warning for each body that touched two pieces of a link at one time. At a
/// cut both resist as if they were alone. An impact's force grows as the 2/5th
/// power of its stiffness (Hertz), so that it may be 1.32 times too large.
[[nodiscard]] std::vector<std::string> find_cut_contacts(
    const scene::Robot& robot, const dynamics::SystemModel& model,
    const std::vector<dynamics::ContactRecord>& records);

}  // namespace limber::runs
