// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>

#include "limber/fem/mesh/mesh.hpp"
#include "limber/fem/mesh/mesh_options.hpp"

/// Part of limber::gmsh, which links Gmsh (GPL).
namespace limber::fem {

/// As read_mesh, but Gmsh runs in this process: a geometry runs its commands
/// with all rights of this process, may end it, and is subject to no limits.
/// Only for trusted files. A Gmsh session of the caller stays open, with its
/// models and the options that are set here.
/// @throws InputError naming the file, what is wrong, what was expected.
[[nodiscard]] Mesh read_mesh_in_process(const std::filesystem::path& file,
                                        const MeshOptions& options = {});

class GmshSession;
struct RawMesh;
/// Called with the number of elements that a geometry's mesh will have about;
/// 0 if that is not known. May be empty.
using CountNote = std::function<void(double elements)>;
/// Meshes the file in this session.
[[nodiscard]] RawMesh make_mesh(GmshSession& session,
                                const std::filesystem::path& file,
                                const MeshOptions& options,
                                const CountNote& note = {});

}  // namespace limber::fem
