// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "limber/fem/gmsh/raw_block.hpp"
#include "limber/fem/mesh/mesh_options.hpp"

namespace limber::fem {

/// A Nastran deck, or an input file of Abaqus or CalculiX. Gmsh, which does not
/// read it, must be initialized: it has the tables of the elements.
/// @param deck with solids @param options unit and force of the deck
/// @throws InputError if it has none
[[nodiscard]] RawMesh make_deck_mesh(const std::filesystem::path& file,
                                     SolidDeck deck,
                                     const MeshOptions& options);

}  // namespace limber::fem
