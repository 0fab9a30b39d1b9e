// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "common/file_stamp.hpp"
#include "fem/mesh.hpp"

namespace limber::fem {

/// What the mesher, a process of its own, answers.
struct MeshReply {
  std::vector<std::string> problems;  ///< of an InputError; else empty
  /// Without `source` and what is found from it (boundary), and with indices
  /// that fit each other; the elements may still be of any quality.
  Mesh mesh;
  /// What was done to the file's own wish to make it a usable mesh.
  std::vector<std::string> notices;
  /// Files that were opened or looked for.
  std::vector<FileStamp> files;
  /// Whether equal files make an equal mesh again: the clock, say, was not
  /// asked.
  bool is_repeatable = false;
};

[[nodiscard]] std::string pack_reply(const MeshReply& reply);
/// @throws InputError if the bytes are no such reply, or one that does not fit
/// together
[[nodiscard]] MeshReply unpack_reply(std::string bytes);

/// Digest of all that shapes a body: node positions, elements with the tables
/// of their types, groups. Not of the file's name.
[[nodiscard]] std::string find_mesh_content(const Mesh& mesh);

}  // namespace limber::fem
