// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace limber {

/// A new folder that this user alone may read. @returns PREFIXxxxxxx
/// @throws std::system_error if it cannot be made.
[[nodiscard]] std::filesystem::path make_private_folder(
    const std::filesystem::path& prefix);

/// A private folder that the destructor removes with all that is in it.
class ScratchFolder {
 public:
  /// @throws std::system_error if it cannot be made.
  explicit ScratchFolder(const std::filesystem::path& prefix)
      : path_(make_private_folder(prefix)) {}
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ~ScratchFolder();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace limber
