// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "limber/fem/matrices/source_matrix.hpp"

namespace limber::fem {

/// Reads lines "node,dof, node,dof, value" of Abaqus' *MATRIX OUTPUT,
/// FORMAT=MATRIX INPUT: lower or upper triangle or both. Negative nodes are
/// internal ones of Abaqus: rows without a node.
/// Source: Abaqus Analysis User's Guide, "Generating structural matrices".
/// @throws InputError with file and line
[[nodiscard]] SourceMatrix read_matrix_input(const std::filesystem::path& file);

/// Reads the text of *SUBSTRUCTURE MATRIX OUTPUT, OUTPUT FILE=USER DEFINED:
/// nodes in comments, *USER ELEMENT with the degrees of freedom, and *MATRIX,
/// TYPE=STIFFNESS and MASS with the rows of the lower triangle. Rows beyond
/// those of the nodes are generalized coordinates.
/// @throws InputError with file and line
[[nodiscard]] std::vector<SourceMatrix> read_substructure(
    const std::filesystem::path& file);

}  // namespace limber::fem
