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
  std::optional<InputDeck> deck;  ///< of which `nodes` are a copy
  bool is_calculix = false;       ///< its .dof is there
  bool is_expanded = false;       ///< from shells or beams, by CalculiX
};

/// Finds out what each file, also in folders, is and reads it.
/// @throws InputError for files that cannot be read, are none of the formats
/// (unless they lie in a folder, where others may lie), or are there twice
[[nodiscard]] FileSet read_file_set(
    const std::vector<std::filesystem::path>& paths);

}  // namespace limber::fem
