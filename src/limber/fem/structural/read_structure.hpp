// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "limber/fem/structural/structure.hpp"

namespace limber::fem {

/// Whether a file is a deck of beams and shells with their properties: .bdf,
/// .nas, .dat of Nastran or .inp of Abaqus and CalculiX. Of another extension
/// it is none, whatever it contains. @param ignored cards, keywords and types
/// of elements that are left out
/// @throws InputError if it cannot be read
[[nodiscard]] bool is_structure(const std::filesystem::path& file,
                                const std::vector<std::string>& ignored = {});

/// @throws InputError with file and line
[[nodiscard]] Structure read_structure(
    const std::filesystem::path& file,
    const std::vector<std::string>& ignored = {});

/// Stiffness, strengths and masses of beams, shells and point masses in newtons
/// and the deck's lengths. @param newtons per unit of force of the deck
void convert_forces(Structure& structure, double newtons);

}  // namespace limber::fem
