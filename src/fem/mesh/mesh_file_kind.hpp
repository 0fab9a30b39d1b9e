// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <filesystem>
#include <string_view>

#include "fem/mesh_options.hpp"

namespace limber::fem {

/// Whether a file holds nodes and elements, or a geometry to be meshed.
enum class MeshFileKind { mesh, geometry };

/// By the file's extension, which must agree with how its content begins: what
/// Gmsh does not know as anything else it runs as a program.
/// @throws InputError naming the file, if it is no regular file that can be
/// read, of an unknown kind, or of another kind than its name says.
[[nodiscard]] MeshFileKind find_mesh_file_kind(
    const std::filesystem::path& file);

/// All extensions that are known, in lower case.
inline constexpr std::array<std::string_view, 12> kMeshFileExtensions = {
    ".msh", ".geo", ".step", ".stp", ".brep", ".iges",
    ".igs", ".bdf", ".nas",  ".unv", ".med",  ".vtk"};

/// @throws InputError naming every option that is out of range, or that a
/// finished mesh cannot follow.
void check_mesh_options(const std::filesystem::path& file, MeshFileKind kind,
                        const MeshOptions& options);

}  // namespace limber::fem
