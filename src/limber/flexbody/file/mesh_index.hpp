// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "limber/common/files/file_stamp.hpp"
#include "limber/common/records/digest.hpp"
#include "limber/flexbody/model/recipe.hpp"

namespace limber::flexbody {

/// The first line of a record in the cache.
inline constexpr std::string_view kMeshRecord = "limber mesh record";

/// Content of a finished mesh, and what it was made from.
struct MeshRecord {
  std::string content;  ///< digest of its nodes, elements and groups
  /// Changes made to the mesh to make it usable.
  std::vector<std::string> notices;
  std::vector<std::string>
      found;  ///< a line for each file of matrices, or material of a deck
  std::vector<FileStamp> files;  ///< opened or searched for in the making
  bool is_repeatable = false;    ///< whether it depends on these only
};

/// Adds all that determines them.
void add_materials(const std::vector<MaterialRegion>& materials,
                   Digest& digest);

/// Adds all that a source states besides its file.
void add_source_options(const MeshSource& source, Digest& digest);

/// The record in `folder` of the mesh that `mesh` requests, if each of its
/// files still matches its stamp: the same mesh would result again. Ignores an
/// entry that is damaged, of another request, of another user or writable by
/// others.
/// @param mesher that would make the mesh; empty: there is none here, and the
/// record of any mesher is accepted
[[nodiscard]] std::optional<MeshRecord> find_mesh_record(
    const MeshSource& mesh, const std::string& mesher,
    const std::filesystem::path& folder);

/// Records a mesh that `mesher` made, if it is repeatable. Atomic. A folder
/// that cannot be written only loses the speed-up.
void keep_mesh_record(const MeshRecord& record, const MeshSource& mesh,
                      const std::string& mesher,
                      const std::filesystem::path& folder);

/// The file of the mesh that a record is of, the first that was opened; empty
/// if the record is damaged.
[[nodiscard]] std::filesystem::path read_mesh_file(
    const std::filesystem::path& record);

}  // namespace limber::flexbody
