// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "limber/common/records/digest.hpp"

namespace limber {

/// The leading part of an append file, independent of what follows it.
struct FilePart {
  std::uint64_t length = 0;  ///< [bytes]
  std::string digest;        ///< of these bytes (XXH3)
};

/// A file of blocks, each stored as its length (8 bytes) and its bytes. Data is
/// synced to disk when `append` returns. A block that a crash truncates lies
/// beyond the known part, and is removed when the file is reopened.
class AppendFile {
 public:
  /// Creates the file, replacing an old one. @throws InputError if it cannot be
  /// written.
  explicit AppendFile(std::filesystem::path file);
  /// Continues after `part`. @throws InputError if the file does not contain it
  /// bit for bit, or cannot be written.
  AppendFile(std::filesystem::path file, const FilePart& part);

  AppendFile(const AppendFile&) = delete;
  AppendFile& operator=(const AppendFile&) = delete;
  ~AppendFile();

  /// @throws InputError if it cannot be written; the file is then as before.
  void append(std::string_view block);

  /// The whole file so far.
  [[nodiscard]] FilePart part() const { return {length_, digest_.text()}; }

 private:
  void open(int flags);
  void write(std::string_view bytes);
  void cut_off();

  std::filesystem::path file_;
  int handle_ = -1;
  std::uint64_t length_ = 0;
  Digest digest_;
};

/// The blocks of a part. @throws InputError if the file does not contain it bit
/// for bit.
[[nodiscard]] std::vector<std::string> read_blocks(
    const std::filesystem::path& file, const FilePart& part);

}  // namespace limber
