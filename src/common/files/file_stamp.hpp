// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace limber {

class Wire;

/// What a file was when it was looked at, so that a later look tells whether
/// it is still the same.
struct FileStamp {
  std::filesystem::path path;  ///< absolute
  /// "absent", "there", "content HEX" or "version SIZE TIME INODE".
  std::string mark;

  bool operator==(const FileStamp&) const = default;
};

/// By its bytes; "there" for what is no regular file.
[[nodiscard]] FileStamp stamp_content(const std::filesystem::path& file);
/// By whether there is such a file at all.
[[nodiscard]] FileStamp stamp_presence(const std::filesystem::path& file);
/// By size, time of change and inode: for programs and libraries, which are
/// large, and replaced as a whole.
[[nodiscard]] FileStamp stamp_version(const std::filesystem::path& file);

/// Whether the file still bears its stamp.
[[nodiscard]] bool is_unchanged(const FileStamp& stamp);

/// As bytes, both ways (common/wire.hpp).
void exchange(Wire& wire, FileStamp& stamp);

}  // namespace limber
