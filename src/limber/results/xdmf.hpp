// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "limber/dynamics/system/system_model.hpp"
#include "limber/results/history.hpp"

namespace limber::results {

/// Writes the flexible bodies' moving surfaces for ParaView, with the fields of
/// xdmf_file.hpp: all stored nodes, stress of bodies with stress modes and at
/// level `full`. Bodies without a mesh are omitted.
/// @returns the omissions: bodies whose surface was not kept, or the whole file
/// if no body has one
/// @throws InputError if it cannot be written.
[[nodiscard]] std::vector<std::string> write_xdmf(
    const std::filesystem::path& file, const dynamics::SystemModel& model,
    const History& history);

}  // namespace limber::results
