// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <string>

#include "common/folder_lock.hpp"

namespace limber::app {

/// A folder that one command at a time writes its results to.
///
/// What a command writes replaces what one before it wrote there: files that
/// are not written again are removed, and folders of results in it.
/// `.limber-files` lists what is so owned; nothing else in the folder is
/// touched.
class OutputFolder {
 public:
  /// Gets the folder to write to, and throws InputError on failure.
  using Writer = std::function<void(const std::filesystem::path&)>;

  /// Makes the folder and locks it, and removes what killed commands left half
  /// done in it.
  /// @throws InputError if it cannot be written, or naming who is at work there
  explicit OutputFolder(std::filesystem::path folder);

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  /// Notes that results folders of these names are made in it by this command.
  /// Once it writes, those that an earlier one made, and it does not, go.
  void claim(const std::set<std::string>& folders);

  /// Has all files of a command written beside their places and then moves them
  /// there. If that fails, they are written to a new folder that only the user
  /// may read, in TMPDIR, /tmp or the current folder.
  /// Where `writer` fails whatever the folder, what it has made is kept.
  /// @throws InputError with what failed, and where the files are instead
  void write(const Writer& writer) const;

 private:
  void place(const std::filesystem::path& made, bool is_all) const;
  void place_if_possible(const std::filesystem::path& made) const;

  std::filesystem::path path_;
  FolderLock lock_;
  std::set<std::string> claimed_;  // as in the list: with a "/" at the end
};

}  // namespace limber::app
