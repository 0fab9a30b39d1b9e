// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/common/files/file_stamp.hpp"
#include "limber/fem/mesh/mesh.hpp"

namespace limber::fem {

/// Reply of the mesher process.
struct MeshReply {
  std::vector<std::string> problems;  ///< of an InputError; else empty
  /// Without `source` and derived data (boundary). Indices are consistent; the
  /// quality of elements is not yet checked.
  Mesh mesh;
  /// Changes made to the mesh to make it usable.
  std::vector<std::string> notices;
  /// Files that were opened or searched for.
  std::vector<FileStamp> files;
  /// Whether the same files give the same mesh again: the clock, for example,
  /// was not read.
  bool is_repeatable = false;
};

[[nodiscard]] std::string pack_reply(const MeshReply& reply);
/// @throws InputError if the bytes are not a consistent reply
[[nodiscard]] MeshReply unpack_reply(std::string bytes);

/// Digest of all that determines a body: node positions, elements with the
/// tables of their types, groups. Excludes the file's name.
[[nodiscard]] std::string find_mesh_content(const Mesh& mesh);

}  // namespace limber::fem
