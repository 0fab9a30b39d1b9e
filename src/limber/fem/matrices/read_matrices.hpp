// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "limber/fem/matrices/matrix_model.hpp"

namespace limber::fem {

/// Where a model is: folders, files or both. What lies deeper in a folder is
/// not read.
struct MatrixFiles {
  std::vector<std::filesystem::path> paths;
  /// Recovery rows and the table of their points, unless `paths` have them.
  std::vector<std::filesystem::path> recovery = {};
};

/// Reads a finite-element model by its matrices: finds by content which file is
/// which (names only break ties), and puts them together. Formats and what is
/// refused: docs/reference/matrices.md.
/// @returns rows in the order of the matrices; where these name them (DMIG,
/// Abaqus), sorted by node and component. Nodes have a row or a condensed one,
/// and are sorted by tag. `found` states as what each file was read.
/// @throws InputError with file, line and what was expected; for a matrix or
/// nodes that are missing, or there twice, with all that was found
[[nodiscard]] MatrixModel read_matrices(const MatrixFiles& files);

}  // namespace limber::fem
