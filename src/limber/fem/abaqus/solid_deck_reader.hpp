// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "limber/fem/mesh/solid_deck.hpp"

namespace limber::fem {

/// Reads an input file of Abaqus or CalculiX: *NODE, solids of *ELEMENT,
/// *ELSET, *NSET, *SURFACE, *INCLUDE, and of parts one instance that is not
/// moved. Source: CalculiX 2.20 User's Manual, ch. 7; Abaqus Keywords Reference
/// Guide
/// @param ignored keywords and types of elements that are left out then, with a
/// notice
/// @returns sets of solids as volume groups with their materials, surfaces and
/// sets of shells that no section describes as groups of faces, sets of nodes
/// as such
/// @throws InputError with file and line, also for what a body of solids cannot
/// have and would be lost: other elements, constraints, contact; nodes and
/// elements that the program generates; a solid with a node twice
[[nodiscard]] SolidDeck read_solid_deck(
    const std::filesystem::path& file,
    const std::vector<std::string>& ignored = {});

}  // namespace limber::fem
