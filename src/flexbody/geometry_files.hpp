// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

namespace limber::flexbody {

/// The files that a Gmsh geometry reads, as far as its text shows them.
struct GeometryFiles {
  /// The geometry, its option file, and what these name word for word, with
  /// what those name; some may not be there.
  std::vector<std::filesystem::path> files;
  /// Whether that is all: no name is put together as the geometry runs.
  bool is_complete = true;
};

/// Follows Include, Merge, ShapeFromFile and whatever else takes a file, from a
/// .geo file (in any case of letters); of any other file, itself.
[[nodiscard]] GeometryFiles find_geometry_files(
    const std::filesystem::path& file);

}  // namespace limber::flexbody
