// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "limber/fem/matrices/model_file.hpp"
#include "limber/fem/matrices/source_matrix.hpp"

namespace limber::fem {

/// Reads a table of nodes: lines node, x, y, z and, if the head line has that
/// column, the components of its rows (123 or 123456), separated by commas,
/// semicolons, blanks or tabs. Before the first number stand comments (#, %, !)
/// and a head line; it is needed unless commas or semicolons separate. Also
/// Ansys' NLIST, whose head is repeated and whose angles must be 0, and
/// Workbench's export of nodes, with decimal commas between tabs.
/// @throws InputError with file and line
[[nodiscard]] ModelFile read_node_table(const std::filesystem::path& file);

/// Reads a table of rows: lines row, node, component. Rows from 1, each once,
/// in any order; components 1 to 6, or UX UY UZ ROTX ROTY ROTZ (RX RY RZ), 0
/// for a scalar row, whose node may be 0. Also Ansys' .mapping.
/// @throws InputError with file and line
[[nodiscard]] RowTable read_row_table(const std::filesystem::path& file);

/// Reads CalculiX's .dof: a line "node.component" for each row.
/// @throws InputError with file and line
[[nodiscard]] RowTable read_dof_lines(const std::filesystem::path& file);

/// Reads Nastran's print of displacement sets in an .f06 (PARAM,USETPRT): a
/// table for each set. @throws InputError with file and line
[[nodiscard]] std::vector<RowTable> read_set_print(
    const std::filesystem::path& file);

}  // namespace limber::fem
