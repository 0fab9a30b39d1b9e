// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <filesystem>
#include <string_view>

#include "limber/fem/mesh/mesh_options.hpp"

namespace limber::fem {

/// Whether a file holds nodes and elements, as a Nastran deck, an input file of
/// Abaqus or CalculiX, an I-deas universal file or in another format that Gmsh
/// reads, or a geometry to be meshed.
enum class MeshFileKind { mesh, bulk_data, input_deck, universal, geometry };

/// By the file's extension, which must agree with how its content begins: Gmsh
/// runs any unrecognised content as a geometry program.
/// @throws InputError naming the file, if it is not a readable regular file, of
/// unknown kind, or of another kind than its extension says.
[[nodiscard]] MeshFileKind find_mesh_file_kind(
    const std::filesystem::path& file);

/// The length unit that a geometry's coordinates have by its file [m]; 0 if it
/// states none. STEP and IGES state theirs, and OpenCASCADE converts them to
/// millimetres.
[[nodiscard]] double find_stated_unit(const std::filesystem::path& file);

/// All known extensions, in lower case.
inline constexpr std::array<std::string_view, 14> kMeshFileExtensions = {
    ".msh", ".geo", ".step", ".stp", ".brep", ".iges", ".igs",
    ".bdf", ".nas", ".dat",  ".inp", ".unv",  ".med",  ".vtk"};

/// @throws InputError naming every option that is out of range or does not
/// apply to a finished mesh.
void check_mesh_options(const std::filesystem::path& file, MeshFileKind kind,
                        const MeshOptions& options);

}  // namespace limber::fem
