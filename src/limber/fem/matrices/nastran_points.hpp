// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "limber/fem/matrices/model_file.hpp"

namespace limber::fem {

/// Reads GRID points, with their coordinate systems, of bulk data or a punch
/// file and, for pictures, its elements. Scalar points (SPOINT) have no
/// position and are not among them.
/// @returns no nodes if there are none
/// @throws InputError with file and line, also for displacements in other axes
/// than the basic ones (GRID's CD)
[[nodiscard]] ModelFile read_nastran_points(const std::filesystem::path& file);

}  // namespace limber::fem
