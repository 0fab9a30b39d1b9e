// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "fem/mesh.hpp"
#include "fem/mesh_options.hpp"

/// Part of limber::gmsh, which links Gmsh (GPL).
namespace limber::fem {

/// As read_mesh, by Gmsh in this process: a geometry then runs its commands
/// with all rights of this process, may end it, and is held by no limit. Only
/// for files that you trust. A Gmsh session of the caller's stays open, with
/// its models and the options that are set here.
/// @throws InputError naming the file, what is wrong, what was expected.
[[nodiscard]] Mesh read_mesh_in_process(const std::filesystem::path& file,
                                        const MeshOptions& options = {});

class GmshSession;
/// A mesh as Gmsh made it, before complete_mesh().
struct RawMesh {
  Mesh mesh;
  /// What was done to the file's own wish to make it a usable mesh.
  std::vector<std::string> notices;
};
/// In that session.
[[nodiscard]] RawMesh make_mesh(GmshSession& session,
                                const std::filesystem::path& file,
                                const MeshOptions& options);

}  // namespace limber::fem
