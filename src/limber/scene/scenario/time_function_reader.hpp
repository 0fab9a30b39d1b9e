// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/dynamics/system/time_function.hpp"
#include "limber/scene/scenario/signal_reader.hpp"
#include "limber/scene/text/toml_table.hpp"

namespace limber::scene {

/// Reads a load's `time` table: kind = "constant", "steps", "pulse",
/// "sinusoid", "sinusoids", "fourier", "table" or "input", with the keys of
/// that kind.
/// @param warnings gets the misfit of a Fourier series from its table
[[nodiscard]] dynamics::TimeFunction read_time_function(
    TomlTable& table, const SignalContext& context,
    std::vector<std::string>& warnings);

}  // namespace limber::scene
