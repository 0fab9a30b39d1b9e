// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "limber/fem/structural/structure.hpp"

namespace limber::fem {

/// Whether an input file has beams or shells that a section describes, and no
/// solids.
[[nodiscard]] bool is_abaqus_structure(const std::filesystem::path& file);

/// Reads B31, S3, S4 (also with reduced integration) and MASS with their
/// sections and materials, *RIGID BODY, *NSET, *ELSET, *ORIENTATION, *INCLUDE
/// of an input file of Abaqus or CalculiX. Sets: those of nodes, and nodes of
/// sets of elements.
/// @throws InputError with file and line, also for what would be lost
[[nodiscard]] Structure read_abaqus_structure(
    const std::filesystem::path& file);

}  // namespace limber::fem
