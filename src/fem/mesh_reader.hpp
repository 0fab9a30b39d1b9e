// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "fem/mesh.hpp"

namespace limber::fem {

struct MeshOptions {
  double size = 0.0;  ///< element size in mesh units; 0: the file's own
  int order = 0;      ///< 1 to 3; 0: the file's own, else 2
  double unit = 1.0;  ///< metres per mesh unit [m]
};

/// Reads .msh (2.2 or 4.1, ASCII or binary), or meshes .geo or .step/.stp.
/// `size` and `order` belong to geometry; with a .msh they are errors.
/// Of a geometry with physical volumes only those are meshed bodies, as when
/// Gmsh saves a mesh. Nodes that no solid element uses are dropped.
/// @throws InputError naming the file, what is wrong, what was expected.
[[nodiscard]] Mesh read_mesh(const std::filesystem::path& file,
                             const MeshOptions& options = {});

}  // namespace limber::fem
