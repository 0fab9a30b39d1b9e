// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <toml++/toml.h>

#include <filesystem>

#include "limber/scene/robot/robot.hpp"

namespace limber::scene {

/// Adds the [[coupler]]s of a scenario to its robot, or to all of its robots as
/// one, whose links and joints they name. Each is the element of a robot's file
/// that its `type` names, with attributes as keys, children as tables, and
/// repeated children as arrays of tables.
/// @param file of the scenario, for messages
/// @throws InputError with every problem, each with its line.
void add_couplers(const toml::table& scenario,
                  const std::filesystem::path& file, Robot& robot);

}  // namespace limber::scene
