// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <set>
#include <string>

#include "limber/fem/structural/structure.hpp"

namespace limber::fem {

/// Whether a Nastran deck has beams or shells with properties.
/// @param ignored names of cards that are left out, in upper case
/// @throws InputError as read_deck
[[nodiscard]] bool is_nastran_structure(const std::filesystem::path& file,
                                        const std::set<std::string>& ignored);

/// Reads CBAR, CBEAM, CQUAD4, CQUADR, CTRIA3, CTRIAR with their properties and
/// materials, CONM2, RBE2, RBE3, RBAR, PARAM,WTMASS and points as
/// read_bulk_data; which nodes solids have, and not their matrices
/// (structure_solids.hpp). Sets: nodes of each property by its number, and
/// those that SPC and SPC1 hold in all components that they have, as "spc:SID".
/// @throws InputError with file and line of all that is wrong, and of other
/// elements, which would be lost
[[nodiscard]] Structure read_nastran_structure(
    const std::filesystem::path& file, const std::set<std::string>& ignored);

}  // namespace limber::fem
