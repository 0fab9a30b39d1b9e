// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "limber/fem/structural/structure.hpp"

namespace limber::fem {

/// Whether a file is a deck of beams and shells with their properties: .bdf,
/// .nas, .dat of Nastran or .inp of Abaqus and CalculiX, without solids. Of
/// another extension it is none, whatever it contains.
/// @throws InputError if it cannot be read
[[nodiscard]] bool is_structure(const std::filesystem::path& file);

/// @throws InputError with file and line
[[nodiscard]] Structure read_structure(const std::filesystem::path& file);

}  // namespace limber::fem
