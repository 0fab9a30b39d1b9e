// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "limber/scene/build/scene.hpp"

namespace limber::scene {

/// The scenario `file` as TOML with `overrides` applied (its keys, [fidelity],
/// [basis], [time]; `rows` and settings of the robot belong to that and are
/// omitted), for a file in `folder`:
/// paths are relative to it. Comments are lost. With a step, `output_interval`
/// becomes at least that step, because steps end at outputs.
/// @throws InputError if the file is not valid TOML.
[[nodiscard]] std::string rewrite_scenario(const std::filesystem::path& file,
                                           const Overrides& overrides,
                                           const std::filesystem::path& folder);

}  // namespace limber::scene
