// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "limber/fem/gmsh/gmsh_session.hpp"
#include "limber/fem/gmsh/unv_check.hpp"
#include "limber/fem/mesh/mesh.hpp"

namespace limber::fem {

/// Compares a finished mesh with what Gmsh read of its file. @returns notices
/// of what was left out: nodes that no solid element uses, elements of surfaces
/// and curves with such nodes, and Gmsh's warnings.
[[nodiscard]] std::vector<std::string> find_mesh_losses(
    const GmshSession& session, const std::filesystem::path& file,
    const Mesh& mesh);

/// @throws InputError if Gmsh did not read all nodes and elements of the text
void check_counts(const std::filesystem::path& file, const UnvContent& content);

/// A geometry must not merge a format that Gmsh reads with losses.
/// @throws InputError naming the file that it merged
void check_merged_files(const GmshSession& session,
                        const std::filesystem::path& file);

}  // namespace limber::fem
