// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "limber/common/files/file_stamp.hpp"
#include "limber/fem/mesh/mesh.hpp"
#include "limber/fem/mesh/mesh_options.hpp"
#include "limber/fem/mesh/mesher.hpp"

namespace limber::fem {

/// Reads a mesh, or meshes a geometry. Kinds: docs/reference/meshes.md.
/// `size` and `order` belong to geometry; with a finished mesh they are errors,
/// except order 2, which puts nodes in the middle of first-order elements'
/// edges. Of a geometry with physical volumes only these are used, as when Gmsh
/// saves a mesh. Nodes that no solid element uses are removed.
///
/// Gmsh runs in a separate process, the mesher, which can only read files: a
/// geometry is a program and may be hostile. fem/gmsh/gmsh_reader.hpp runs Gmsh
/// in this process, without that protection.
/// @throws InputError naming the file, what is wrong, what was expected.
[[nodiscard]] Mesh read_mesh(const std::filesystem::path& file,
                             const MeshOptions& options, const Mesher& mesher);
/// By find_mesher().
[[nodiscard]] Mesh read_mesh(const std::filesystem::path& file,
                             const MeshOptions& options = {});

/// A mesh and its sources.
struct TracedMesh {
  Mesh mesh;
  /// Changes made to the mesh to make it usable.
  std::vector<std::string> notices;
  std::vector<FileStamp> files;  ///< files that it depends on
  bool is_repeatable = false;    ///< whether it depends on these files only
};
/// As read_mesh.
[[nodiscard]] TracedMesh read_traced_mesh(const std::filesystem::path& file,
                                          const MeshOptions& options,
                                          const Mesher& mesher,
                                          const Progress& progress = {});
/// By find_mesher().
[[nodiscard]] TracedMesh read_traced_mesh(const std::filesystem::path& file,
                                          const MeshOptions& options = {},
                                          const Progress& progress = {});

/// Finds the boundary and checks the invariants of Mesh.
/// @throws InputError naming element and file
void complete_mesh(Mesh& mesh);

}  // namespace limber::fem
