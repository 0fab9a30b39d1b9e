// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace limber {

/// A kind of input: its name in messages and its largest size in bytes.
struct InputKind {
  std::string_view name;
  std::uint64_t most_bytes;
};

inline constexpr InputKind kMeshInput = {"mesh or geometry",
                                         std::uint64_t{1} << 32};

/// A user's file opened for reading: a regular file of bounded size. A pipe
/// would block, a device has no end, and a folder no content.
class InputFile {
 public:
  /// @throws InputError naming the file, what it is and what is expected.
  InputFile(std::filesystem::path file, const InputKind& kind);
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;
  ~InputFile();

  /// Fills `out`, or less at the end of the file. @returns the bytes read
  /// @throws InputError if reading fails, or beyond the largest size of its
  /// kind (a file may grow).
  std::size_t read(char* out, std::size_t size);

 private:
  [[noreturn]] void refuse(const std::string& why) const;
  void check_size(std::uint64_t size) const;

  std::filesystem::path file_;
  InputKind kind_;
  int descriptor_ = -1;
  std::uint64_t read_ = 0;
};

/// The whole content. @throws InputError as InputFile.
[[nodiscard]] std::string read_input(const std::filesystem::path& file,
                                     const InputKind& kind);

/// The checks alone, for a library that opens the file itself. @throws
/// InputError likewise.
void check_input(const std::filesystem::path& file, const InputKind& kind);

}  // namespace limber
