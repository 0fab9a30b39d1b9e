// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "limber/fem/mesh/solid_deck.hpp"

namespace limber::fem {

/// Reads CTETRA, CPENTA, CHEXA and CPYRAM of 1st or 2nd order, GRID, GRDSET,
/// CORD1 and CORD2 in small, large and free fields, with INCLUDE files. Format:
/// MSC Nastran Quick Reference Guide, "Bulk Data Entries".
/// @throws InputError with file and line of all that is wrong, and of other
/// elements, which would be lost: shells, beams, masses, rigid elements; of
/// constraints between points (MPC). Blank mid-side nodes of an element of
/// second order are filled (MidSideNodes), with a notice
/// @param ignored names of such cards that are left out, with a notice
/// @returns each property (PID) as a region and a volume group of its number,
/// with its material (MAT1, MAT9, MAT11)
[[nodiscard]] SolidDeck read_bulk_data(
    const std::filesystem::path& file,
    const std::vector<std::string>& ignored = {});

}  // namespace limber::fem
