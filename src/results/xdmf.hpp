// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "limber/dynamics/system/system_model.hpp"
#include "limber/results/history.hpp"

namespace limber::results {

/// Writes a time series of the flexible bodies' moving surfaces for ParaView:
/// `file` (XDMF) and its data beside it (the same name with .h5). The point
/// field "deformation" is |Phi eta| [m], "deformation_vector" that as a vector
/// and "displacement" from the first output, both in the world frame [m], for
/// ParaView's filter Warp By Vector. Bodies without a mesh are omitted.
/// @throws InputError if it cannot be written or no body has a mesh.
void write_xdmf(const std::filesystem::path& file,
                const dynamics::SystemModel& model, const History& history);

}  // namespace limber::results
