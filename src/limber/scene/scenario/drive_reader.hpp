// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

#include "limber/scene/scenario/scenario.hpp"
#include "limber/scene/scenario/signal_reader.hpp"
#include "limber/scene/text/toml_table.hpp"

namespace limber::scene {

/// Reads a [[drive]]. Its name defaults to that of its joint or tendon.
[[nodiscard]] DriveSpec read_drive(TomlTable& table,
                                   const SignalContext& context);

/// Reads a [[release]] of a latch that is not yet in `releases`.
void read_release(TomlTable& table, std::map<std::string, double>& releases);

}  // namespace limber::scene
