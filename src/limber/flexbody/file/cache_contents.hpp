// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace limber::flexbody {

/// A file of Limber's in a cache folder.
struct CacheItem {
  enum class Kind {
    body,        ///< KEY.h5, and KEY.origin beside it
    mesh,        ///< KEY.mesh: which mesh results from which files
    damaged,     ///< a body that cannot be read any more
    unfinished,  ///< left by a process that ended in the middle of writing
  };
  Kind kind = Kind::body;
  std::vector<std::filesystem::path> files;
  std::uintmax_t bytes = 0;
  double age = 0.0;            ///< since its last use [s]
  std::string name;            ///< of the body when it was reduced
  std::filesystem::path mesh;  ///< file of the mesh; empty: not recorded
  std::size_t nodes = 0;       ///< of the body's mesh
  std::size_t modes = 0;
};

struct CacheContents {
  std::vector<CacheItem> items;  ///< the longest unused first
  std::size_t others = 0;        ///< files and folders that are not of a cache
};

/// Of a folder; empty where there is none. Reads every body whole.
/// @throws InputError if the folder cannot be read.
[[nodiscard]] CacheContents read_cache(const std::filesystem::path& folder);

/// Records what `body` in a cache was reduced from.
/// @throws on any failure to write
void write_origin(const std::filesystem::path& body,
                  const std::filesystem::path& mesh);

/// Removes the files of these items while no other process cleans the folder. A
/// program that is reading one is not disturbed; one that needs it later
/// recreates it. Ignores files that no longer exist.
/// @throws InputError if another process holds the folder, or if a file cannot
/// be removed.
void remove_from_cache(const std::filesystem::path& folder,
                       const std::vector<CacheItem>& items);

}  // namespace limber::flexbody
