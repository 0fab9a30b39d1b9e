// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace limber {

/// A new file that is being written. It is registered with
/// `remove_unfinished_files`, and the destructor removes it unless `move_to`
/// was called.
class UnfinishedFile {
 public:
  /// Creates an empty file beside `file` with an unpredictable name,
  /// FILE.part-PID-XXXXXX. Removes such files of `file` that are at least an
  /// hour old and whose process no longer exists.
  /// @throws InputError if it cannot be created.
  explicit UnfinishedFile(const std::filesystem::path& file);
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;
  ~UnfinishedFile();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  /// Syncs it to disk and renames it to `file`; syncs the folder entry too.
  /// @throws InputError if that fails.
  void move_to(const std::filesystem::path& file);

 private:
  std::filesystem::path path_;
  int slot_ = -1;  // of its name, for signal handlers
};

/// Removes the unfinished files of this process. Async-signal-safe.
void remove_unfinished_files() noexcept;

/// Whether it is an unfinished file, at least an hour old, of a process that no
/// longer exists.
[[nodiscard]] bool is_stale_part(const std::filesystem::path& file);

/// Removes all unfinished files in a folder that no other process writes to.
void remove_stale_parts(const std::filesystem::path& folder);

}  // namespace limber
