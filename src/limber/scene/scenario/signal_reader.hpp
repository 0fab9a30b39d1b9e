// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "limber/joints/scalar/signal.hpp"
#include "limber/scene/text/toml_table.hpp"

namespace limber::scene {

/// Context that signals of a scenario refer to.
struct SignalContext {
  const std::filesystem::path& folder;  ///< to which file names are relative
  /// Names of controllers, in the order of the inputs that they write.
  const std::vector<std::string>& controllers;
};

/// Reads `controller` and `factor` of a table that follows an input.
[[nodiscard]] joints::InputSignal read_input_signal(
    TomlTable& table, const std::vector<std::string>& controllers);

/// Reads a table { kind = ... }.
[[nodiscard]] joints::Signal read_base_signal(TomlTable& table,
                                              const SignalContext& context);

/// Reads `signal = { kind = ... }` and the optional `shaper` of a drive's
/// table.
[[nodiscard]] joints::Signal read_signal(TomlTable& drive,
                                         const SignalContext& context);

}  // namespace limber::scene
