// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/scene/scenario/scenario.hpp"
#include "limber/scene/scenario/signal_reader.hpp"
#include "limber/scene/text/toml_table.hpp"

namespace limber::scene {

/// Names of all [[controller]]s, in the file's order; empty where there is
/// none.
[[nodiscard]] std::vector<std::string> list_controllers(TomlTable& root);

/// Reads a [[controller]].
[[nodiscard]] ControllerSpec read_controller(TomlTable& table,
                                             const SignalContext& context);

}  // namespace limber::scene
