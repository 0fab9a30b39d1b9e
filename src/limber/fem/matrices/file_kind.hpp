// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string_view>

namespace limber::fem {

enum class ModelFileKind {
  unknown,
  binary,
  matrix_market,
  node_map,  ///< Ansys' vector of nodes in Matrix Market form
  coordinates,
  matrix_input,
  substructure,
  harwell_boeing,
  op4,
  nastran,  ///< DMIG cards, GRID points or both
  input_deck,
  dof_lines,
  row_table,
  node_table,
  ansys_archive,
  frd,
  expansion,
  set_print
};

/// "Matrix Market"
[[nodiscard]] std::string_view name_of(ModelFileKind kind);

/// By its beginning; its name counts for Nastran's .f06 alone, which is
/// searched for tables of sets. @throws InputError if it cannot be read
[[nodiscard]] ModelFileKind recognise_file(const std::filesystem::path& file);

}  // namespace limber::fem
