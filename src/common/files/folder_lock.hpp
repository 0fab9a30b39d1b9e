// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace limber {

/// A folder for one process at a time, by the lock (flock) of a file in it,
/// `.limber-lock`, that names the process. The kernel lets go of it when the
/// process ends, however it ends.
///
/// Limits     Some network file systems have no such locks: then none is held.
class FolderLock {
 public:
  /// @throws InputError if another process holds it, naming that, or if the
  /// file cannot be made.
  explicit FolderLock(const std::filesystem::path& folder);
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  ~FolderLock();

  [[nodiscard]] bool is_held() const { return is_held_; }

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
  bool is_held_ = false;
};

}  // namespace limber
