// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace limber {

/// Reserves a folder for one process by a lock (flock) on its file
/// `.limber-lock`, which names the process. The kernel releases it when the
/// process ends, however it ends.
///
/// Limits     no lock is held on network file systems without flock
class FolderLock {
 public:
  /// @throws InputError if another process holds it, naming that process, or if
  /// the file cannot be created.
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
