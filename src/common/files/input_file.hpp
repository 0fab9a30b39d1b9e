// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace limber {

/// What a reader takes: its name in messages, and the most bytes it may have.
struct InputKind {
  std::string_view name;
  std::uint64_t most_bytes;
};

inline constexpr InputKind kMeshInput = {"mesh or geometry",
                                         std::uint64_t{1} << 32};

/// A file of a user's, open for reading: a regular one of bounded size. A pipe
/// would be waited for, a device has no end, and a folder no content.
class InputFile {
 public:
  /// @throws InputError naming the file, what it is and what is expected.
  InputFile(std::filesystem::path file, const InputKind& kind);
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;
  ~InputFile();

  /// Fills `out`, but for the end of the file. @returns the bytes read
  /// @throws InputError if reading fails, or past the most bytes of its kind:
  /// a file may grow.
  std::size_t read(char* out, std::size_t size);

 private:
  [[noreturn]] void refuse(const std::string& why) const;
  void check_size(std::uint64_t size) const;

  std::filesystem::path file_;
  InputKind kind_;
  int descriptor_ = -1;
  std::uint64_t read_ = 0;
};

/// All of it. @throws InputError as InputFile.
[[nodiscard]] std::string read_input(const std::filesystem::path& file,
                                     const InputKind& kind);

/// For a library that opens a file by its name. @throws InputError likewise.
void check_input(const std::filesystem::path& file, const InputKind& kind);

}  // namespace limber
