// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace limber {

class Wire;

/// Identity of a file at one moment, to detect later whether it has changed.
struct FileStamp {
  std::filesystem::path path;  ///< absolute
  /// "absent", "there", "content HEX" or "version SIZE TIME INODE".
  std::string mark;

  bool operator==(const FileStamp&) const = default;
};

/// By its bytes; "there" for anything but a regular file.
[[nodiscard]] FileStamp stamp_content(const std::filesystem::path& file);
/// By whether the file exists.
[[nodiscard]] FileStamp stamp_presence(const std::filesystem::path& file);
/// By size, modification time and inode: for programs and libraries, which are
/// large and replaced as a whole.
[[nodiscard]] FileStamp stamp_version(const std::filesystem::path& file);

/// Whether the file still matches its stamp.
[[nodiscard]] bool is_unchanged(const FileStamp& stamp);

/// Serialises or deserialises (common/records/wire.hpp).
void exchange(Wire& wire, FileStamp& stamp);

}  // namespace limber
