// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>

#include "limber/flexbody/file/mesh_index.hpp"
#include "limber/flexbody/model/recipe.hpp"

namespace limber::flexbody {

/// The folder of reduced bodies that came with Limber: KEY.h5 as in a cache,
/// and KEY.shipped, which mesh results from which file, wherever that is.
/// Empty if there is none.
[[nodiscard]] std::filesystem::path find_shipped_bodies();

/// Records in `folder` which mesh was made. Names the mesh's file by its bytes
/// and its name alone, others in its folder relative to that; the programs that
/// made it do not count, as the record comes with its mesh's result.
/// @returns whether it was recorded: not if the mesh is not repeatable or
/// depends on files elsewhere.
/// @throws on any failure to write
bool ship_mesh_record(const MeshRecord& record, const MeshSource& mesh,
                      const std::filesystem::path& folder);

/// The record in `folder` of the mesh that `mesh` requests, if its file has the
/// same bytes and name, and the files beside it are as they were. Ignores an
/// entry that is damaged, of another user or writable by others.
[[nodiscard]] std::optional<MeshRecord> find_shipped_mesh(
    const MeshSource& mesh, const std::filesystem::path& folder);

}  // namespace limber::flexbody
