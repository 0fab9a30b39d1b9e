// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "limber/fem/matrices/source_matrix.hpp"

namespace limber::fem {

/// Reads the matrices on DMIG cards of bulk data or a punch file, in small,
/// large and free fields: IFO 1, 2, 6 or 9, real in single or double
/// precision. Other cards are ignored; INCLUDE files are not followed.
/// Source: MSC Nastran Quick Reference Guide, "DMIG".
/// @returns none if there are no such cards
/// @throws InputError with file and line
[[nodiscard]] std::vector<SourceMatrix> read_dmig(
    const std::filesystem::path& file);

}  // namespace limber::fem
