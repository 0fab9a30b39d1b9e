// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "limber/fem/matrices/source_matrix.hpp"

namespace limber::fem {

/// Reads lines "row column value", rows from 1: CalculiX's .sti and .mas (upper
/// triangle), Abaqus' *MATRIX OUTPUT, FORMAT=COORDINATE (both). Lines that
/// begin with * are comments. The size is the largest row.
/// Source: CalculiX 2.20, mastrixstorage; Abaqus Analysis User's Guide,
/// "Generating structural matrices".
/// @throws InputError with file and line
[[nodiscard]] SourceMatrix read_coordinate_text(
    const std::filesystem::path& file);

}  // namespace limber::fem
