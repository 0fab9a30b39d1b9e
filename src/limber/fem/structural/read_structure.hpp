// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "limber/fem/structural/structure.hpp"

namespace limber::fem {

/// Whether a file is a deck of beams and shells with their properties: .bdf,
/// .nas, .dat of Nastran or .inp of Abaqus and CalculiX. Of another extension
/// it is none, whatever it contains. @param with_solids whether it may have
/// solids, too
/// @throws InputError if it cannot be read
[[nodiscard]] bool is_structure(const std::filesystem::path& file,
                                bool with_solids);

/// @throws InputError with file and line
[[nodiscard]] Structure read_structure(const std::filesystem::path& file);

}  // namespace limber::fem
