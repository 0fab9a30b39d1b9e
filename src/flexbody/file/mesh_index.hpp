// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/file_stamp.hpp"
#include "flexbody/recipe.hpp"

namespace limber::flexbody {

/// What a mesh that was made is, and what it was made from.
struct MeshRecord {
  std::string content;  ///< digest of its nodes, elements and groups
  /// What was done to the file's own wish to make it a usable mesh.
  std::vector<std::string> notices;
  std::vector<FileStamp> files;  ///< opened or looked for as it was made
  bool is_repeatable = false;    ///< whether it depends on nothing else
};

/// What `folder` remembers of the mesh that `mesh` asks for, if each of the
/// files still bears its stamp: then it would result again. An entry that is
/// damaged, of another request, of another user or for others to write counts
/// as none.
/// @param mesher who would make the mesh; empty: nobody here, and what any
/// mesher made holds
[[nodiscard]] std::optional<MeshRecord> find_mesh_record(
    const MeshSource& mesh, const std::string& mesher,
    const std::filesystem::path& folder);

/// Remembers a mesh that `mesher` made, if it is repeatable, whole or not at
/// all. A folder that cannot be written only costs the speed-up.
void keep_mesh_record(const MeshRecord& record, const MeshSource& mesh,
                      const std::string& mesher,
                      const std::filesystem::path& folder);

}  // namespace limber::flexbody
