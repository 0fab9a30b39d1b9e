// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Sparse>
#include <string>

#include "limber/fem/matrices/file_set.hpp"

namespace limber::fem {

/// Labels the rows of a matrix that only numbers them: by a table of rows of
/// its size, by a map of nodes, or by the nodes, which have 3 or 6 rows each.
/// @param rows of the matrix, which grows to as many
/// @throws InputError if no table or list of nodes fits, or two do
void label_rows(FileSet& set, Eigen::Index rows, SourceMatrix& source);

/// Labels recovery rows by a table of their points; none if it does not fit.
void label_by_points(const ModelFile& points, SourceMatrix& recovery);

/// @throws InputError for a node's component that two rows have
void check_twice(const SourceMatrix& source);

/// All that was found, for messages.
[[nodiscard]] std::string list_found(const FileSet& set);

}  // namespace limber::fem
