// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "limber/fem/matrices/source_matrix.hpp"

namespace limber::fem {

/// Reads a Matrix Market file: coordinate or array, real or integer, symmetric
/// (lower triangle) or general. Also Ansys' *EXPORT,,MMF.
/// Source: Boisvert, Pozo, Remington, "The Matrix Market Exchange Formats",
/// NISTIR 5935 (1996).
/// A general matrix that is not square is one of recovery rows.
/// @param is_recovery whether it is one whatever its shape
/// @throws InputError with file and line
[[nodiscard]] SourceMatrix read_matrix_market(const std::filesystem::path& file,
                                              bool is_recovery = false);

/// Reads a vector of integers (array, n x 1): the node of each block of rows,
/// as Ansys exports its mapping. @throws InputError with file and line
[[nodiscard]] std::vector<long> read_node_map(
    const std::filesystem::path& file);

}  // namespace limber::fem
