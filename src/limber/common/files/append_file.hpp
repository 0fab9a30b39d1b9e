// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

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

  /// The next block; none at the end.
  using Blocks = std::function<std::optional<std::string>()>;

  /// All blocks, or none.
  /// @throws InputError if it cannot be written; the file is then as before.
  void append(const Blocks& next);
  void append(std::string block);

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

/// Visits the blocks of a part one after the other, so that only one is in
/// memory.
/// @throws InputError, before any visit, if the file does not contain the part
/// bit for bit.
void visit_blocks(const std::filesystem::path& file, const FilePart& part,
                  const std::function<void(std::string)>& visit);

}  // namespace limber
