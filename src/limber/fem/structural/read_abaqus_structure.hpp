// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <set>
#include <string>

#include "limber/fem/structural/structure.hpp"

namespace limber::fem {

/// Whether an input file has beams or shells that a section describes, or
/// solids with rigid bodies, couplings or multi-point constraints.
/// @param ignored names of keywords and types of elements that are left out,
/// in upper case
[[nodiscard]] bool is_abaqus_structure(const std::filesystem::path& file,
                                       const std::set<std::string>& ignored);

/// Reads B31, S3, S4 (also with reduced integration) and MASS with their
/// sections and materials, *RIGID BODY, *COUPLING, *MPC, *SURFACE, *NSET,
/// *ELSET, *ORIENTATION, *INCLUDE, *PART, *INSTANCE of an input file of Abaqus
/// or CalculiX; of solids their nodes, and not their matrices
/// (structure_solids.hpp). Sets: those of nodes, and nodes of sets of elements.
/// @throws InputError with file and line, also for what would be lost
[[nodiscard]] Structure read_abaqus_structure(
    const std::filesystem::path& file, const std::set<std::string>& ignored);

}  // namespace limber::fem
