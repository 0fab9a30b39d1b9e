// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "scene/scene.hpp"

namespace limber::scene {

/// The scenario `file` as TOML with `overrides` written into it ([fidelity],
/// [basis], [time]; `rows` belong to the robot and are left out), to be put
/// into `folder`: paths lead from there. Comments are lost. With a step,
/// `output_interval` becomes at least that step, because steps end on outputs.
/// @throws InputError if the file cannot be read as TOML.
[[nodiscard]] std::string rewrite_scenario(const std::filesystem::path& file,
                                           const Overrides& overrides,
                                           const std::filesystem::path& folder);

}  // namespace limber::scene
