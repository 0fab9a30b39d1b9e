// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "limber/common/types.hpp"

namespace limber::fem {

/// Solid elements of one type, in Gmsh's numbers of types and order of nodes.
struct BulkSolids {
  int gmsh_type = 0;
  int nodes_each = 0;
  std::vector<std::size_t> elements;  ///< their numbers in the deck
  std::vector<std::size_t> nodes;     ///< GRID numbers
  std::vector<int> properties;        ///< their PID
};

/// Nodes and solid elements of a Nastran deck.
struct BulkData {
  std::vector<std::size_t> grids;  ///< ascending GRID numbers
  Matrix3X x;                      ///< in the basic system [deck units]
  std::vector<BulkSolids> solids;
  /// Cards without effect here, and GRIDs without a solid.
  std::vector<std::string> notices;
};

/// Reads CTETRA, CPENTA, CHEXA and CPYRAM of 1st or 2nd order, GRID, GRDSET,
/// CORD1 and CORD2 in small, large and free fields, with INCLUDE files. Format:
/// MSC Nastran Quick Reference Guide, "Bulk Data Entries".
/// @throws InputError with file and line of all that is wrong, and of other
/// elements, which would be lost: shells, beams, masses, rigid elements; of
/// constraints between points (MPC); and of blank mid-side nodes
[[nodiscard]] BulkData read_bulk_data(const std::filesystem::path& file);

}  // namespace limber::fem
