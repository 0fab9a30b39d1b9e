// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "limber/fem/matrices/model_file.hpp"

namespace limber::fem {

/// Reads nodes (NBLOCK), node components (CMBLOCK) and, for pictures, elements
/// (EBLOCK) of an Ansys archive, as CDWRITE writes it.
/// @throws InputError with file and line, also for nodes with rotated axes
[[nodiscard]] ModelFile read_ansys_archive(const std::filesystem::path& file);

}  // namespace limber::fem
