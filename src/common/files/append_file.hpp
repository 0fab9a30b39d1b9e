// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "common/digest.hpp"

namespace limber {

/// A part of an append file, from its start: whatever comes after it.
struct FilePart {
  std::uint64_t length = 0;  ///< bytes
  std::string digest;        ///< of all of them (XXH3)
};

/// A file that grows by blocks, each its length (8 bytes) and its bytes. What
/// was appended is on the disk when `append` returns. A block that a crash
/// cuts short is beyond the part that is known, and is cut off when the file
/// is opened again.
class AppendFile {
 public:
  /// Makes the file anew. @throws InputError if it cannot be written.
  explicit AppendFile(std::filesystem::path file);
  /// Goes on after `part`. @throws InputError if it is not there to the bit,
  /// or cannot be written.
  AppendFile(std::filesystem::path file, const FilePart& part);

  AppendFile(const AppendFile&) = delete;
  AppendFile& operator=(const AppendFile&) = delete;
  ~AppendFile();

  /// @throws InputError if it cannot be written; the file is then as before.
  void append(std::string_view block);

  /// All of it so far.
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

/// The blocks of a part. @throws InputError if it is not there to the bit.
[[nodiscard]] std::vector<std::string> read_blocks(
    const std::filesystem::path& file, const FilePart& part);

}  // namespace limber
