// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "limber/fem/gmsh/raw_block.hpp"

namespace limber::fem {

/// A Nastran deck. Gmsh, which does not read it, must be initialized: it has
/// the tables of the elements. Each property (PID) is a volume group of its
/// number. @param unit metres per length unit of the deck [m]
/// @throws InputError with file and line
[[nodiscard]] RawMesh read_bulk_mesh(const std::filesystem::path& file,
                                     double unit);

}  // namespace limber::fem
