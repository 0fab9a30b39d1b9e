// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/file_stamp.hpp"
#include "fem/mesh.hpp"
#include "fem/mesh_options.hpp"
#include "fem/mesher.hpp"

namespace limber::fem {

/// Reads a mesh, or meshes a geometry; docs/formats/meshes.md lists the kinds.
/// `size` and `order` belong to geometry; with a finished mesh they are errors.
/// Of a geometry with physical volumes only those are meshed bodies, as when
/// Gmsh saves a mesh. Nodes that no solid element uses are dropped.
///
/// Gmsh runs in a process of its own, the mesher, which can read files and no
/// more: a geometry is a program of whoever wrote it. To run Gmsh in this
/// process, with all that it may do then, see fem/gmsh_reader.hpp.
/// @throws InputError naming the file, what is wrong, what was expected.
[[nodiscard]] Mesh read_mesh(const std::filesystem::path& file,
                             const MeshOptions& options, const Mesher& mesher);
/// By find_mesher().
[[nodiscard]] Mesh read_mesh(const std::filesystem::path& file,
                             const MeshOptions& options = {});

/// A mesh and what it was made from.
struct TracedMesh {
  Mesh mesh;
  /// What was done to the file's own wish to make it a usable mesh.
  std::vector<std::string> notices;
  std::vector<FileStamp> files;  ///< files that it depends on
  bool is_repeatable = false;    ///< whether it depends on nothing else
};
/// As read_mesh.
[[nodiscard]] TracedMesh read_traced_mesh(const std::filesystem::path& file,
                                          const MeshOptions& options,
                                          const Mesher& mesher);
/// By find_mesher().
[[nodiscard]] TracedMesh read_traced_mesh(const std::filesystem::path& file,
                                          const MeshOptions& options = {});

/// Finds the boundary, and checks that the mesh is what Mesh promises.
/// @throws InputError naming element and file
void complete_mesh(Mesh& mesh);

}  // namespace limber::fem
