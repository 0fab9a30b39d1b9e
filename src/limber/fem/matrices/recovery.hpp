// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <unordered_map>
#include <vector>

#include "limber/fem/matrices/file_set.hpp"

/// Recovery rows of a superelement (output transformation matrix): how points
/// that have no rows of their own move with those of the matrices.
namespace limber::fem {

/// Labels the rows of the set's recovery matrix: by its table of rows, or by
/// its points, of which each has its components, 3 or 6.
/// @param rows of the stiffness, which are the matrix's columns
/// @throws InputError if it has other columns, or no points fit its rows
void check_recovery(FileSet& set, std::size_t rows);

/// Positions of the table of points. @throws InputError for one that the
/// model's nodes have elsewhere
[[nodiscard]] std::map<long, Vector3> list_points(const FileSet& set);

/// Adds the matrix's rows to the condensed unknowns. Those that the model has
/// itself must be unit rows.
/// @param places of nodes in the model
/// @throws InputError
void add_recovery(FileSet& set, const std::vector<RowLabel>& labels,
                  const std::unordered_map<long, int>& places,
                  MatrixModel& model);

}  // namespace limber::fem
