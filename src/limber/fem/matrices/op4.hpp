// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "limber/fem/matrices/source_matrix.hpp"

namespace limber::fem {

/// Reads the square matrices of a Nastran OUTPUT4 file in ASCII: dense, sparse
/// or BIGMAT, real in single or double precision. Lengths may be counted in
/// words or in numbers. Matrices that are not square are ignored.
/// Source: MSC Nastran DMAP Programmer's Guide, "OUTPUT4".
/// @param is_recovery all are recovery rows, whatever their shape
/// @throws InputError with file and line
[[nodiscard]] std::vector<SourceMatrix> read_op4(
    const std::filesystem::path& file, bool is_recovery = false);

}  // namespace limber::fem
