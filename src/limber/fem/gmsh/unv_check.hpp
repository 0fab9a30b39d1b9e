// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>

namespace limber::fem {

/// What an I-deas universal file holds, by its text.
struct UnvContent {
  std::size_t nodes = 0;     ///< dataset 2411
  std::size_t elements = 0;  ///< dataset 2412
  double unit = 0.0;         ///< dataset 164 [m]; 0: none
};

/// Reads what Gmsh passes over in silence. Format: SDRC, "Universal file
/// datasets" 164, 2411, 2412, 2420.
/// @throws InputError with file and line of a dataset that does not end, older
/// datasets of nodes and elements, elements that are neither solids nor marks
/// of faces and edges, and nodes in a coordinate system of their own
[[nodiscard]] UnvContent check_unv(const std::filesystem::path& file);

}  // namespace limber::fem
