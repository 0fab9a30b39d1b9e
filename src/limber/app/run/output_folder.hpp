// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <string>

#include "limber/common/files/folder_lock.hpp"

namespace limber::app {

/// Results folder of one command at a time.
///
/// A command's output replaces that of the previous command: files and results
/// folders that are not written again are removed. `.limber-files` lists the
/// owned files; nothing else in the folder is touched.
class OutputFolder {
 public:
  /// Writes to the given folder; throws InputError on failure.
  using Writer = std::function<void(const std::filesystem::path&)>;

  /// Creates the folder and locks it, and removes unfinished files of killed
  /// commands.
  /// @throws InputError if it cannot be written, or another process uses it,
  /// naming that process
  explicit OutputFolder(std::filesystem::path folder);

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  /// Declares the results folders that this command creates in it. `write`
  /// removes those of an earlier command that are not among them.
  void claim(const std::set<std::string>& folders);

  /// Has `writer` write all files to a temporary folder next to their
  /// destination and then moves them there. If that fails, they are written to
  /// a new folder that only the user may read, in TMPDIR, /tmp or the current
  /// folder. If `writer` fails in every folder, its partial output is kept.
  /// @throws InputError with the failure and where the files are instead
  void write(const Writer& writer) const;

  /// Writes more files of the same command, in addition to those of
  /// `write`.
  void add(const Writer& writer) const;

 private:
  void write_all(const Writer& writer, bool is_all) const;
  void place(const std::filesystem::path& made, bool is_all) const;
  void place_if_possible(const std::filesystem::path& made) const;

  std::filesystem::path path_;
  FolderLock lock_;
  std::set<std::string> claimed_;  // as in the list: ending in "/"
};

}  // namespace limber::app
