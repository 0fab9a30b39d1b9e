// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace limber {

/// A new file that is being written: while it lives, it is known to
/// `remove_unfinished_files`, and it goes with its object unless it is kept.
class UnfinishedFile {
 public:
  /// Makes an empty file beside `file`, with a name that nobody can foresee:
  /// FILE.part-PID-XXXXXX. Of `file`, what processes that are gone left behind
  /// an hour ago or earlier is removed.
  /// @throws InputError if it cannot be made.
  explicit UnfinishedFile(const std::filesystem::path& file);
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;
  ~UnfinishedFile();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  /// Puts it on the disk and in the place of `file`, folder entry included.
  /// @throws InputError if that fails.
  void move_to(const std::filesystem::path& file);

 private:
  std::filesystem::path path_;
  int slot_ = -1;  // where signal handlers find its name
};

/// Removes the unfinished files of this process. For signal handlers.
void remove_unfinished_files() noexcept;

/// Removes all unfinished files in a folder that nobody else writes to.
void remove_stale_parts(const std::filesystem::path& folder);

}  // namespace limber
