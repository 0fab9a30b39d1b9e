// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "limber/fem/matrices/calculix_model.hpp"
#include "limber/fem/matrices/model_file.hpp"
#include "limber/fem/matrices/source_matrix.hpp"

namespace limber::fem {

/// The parts of a model, each from its file.
struct FileSet {
  std::string source;              ///< folder or files, for messages
  std::vector<std::string> found;  ///< a line for each file
  std::vector<SourceMatrix> matrices;
  std::vector<RowTable> row_tables;
  std::vector<long> node_map;  ///< node of each block of rows; or none
  std::optional<ModelFile> nodes;
  std::optional<RowTable> recovery_rows;  ///< of the recovery matrix
  std::optional<ModelFile> points;        ///< of these rows
  std::optional<InputDeck> deck;          ///< of which `nodes` are a copy
  bool is_calculix = false;               ///< its .dof is there
  bool is_expanded = false;               ///< from shells or beams, by CalculiX
};

/// The only matrix of a role, null if there is none. @throws InputError if
/// there are two, which it calls `name`
[[nodiscard]] SourceMatrix* find_role(FileSet& set, MatrixRole role,
                                      const char* name);
/// The matrix of recovery rows.
[[nodiscard]] SourceMatrix* find_recovery(FileSet& set);

/// Determines the kind of each file, also in folders, and reads it.
/// @param recovery files of recovery rows: a matrix, tables of points and rows
/// @throws InputError for files that cannot be read, are none of the formats
/// (unless they lie in a folder, where others may lie), or are there twice
[[nodiscard]] FileSet read_file_set(
    const std::vector<std::filesystem::path>& paths,
    const std::vector<std::filesystem::path>& recovery = {});

}  // namespace limber::fem
