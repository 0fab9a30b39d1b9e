// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "support/sanitized.hpp"
#include "support/temporary_folder.hpp"

namespace limber::test {

struct CommandResult {
  int status = -1;     ///< exit status
  std::string out;     ///< standard output
  std::string errors;  ///< standard error
};

/// Where commands of a test keep reduced bodies: with those of all tests of the
/// process, each made once, or by themselves.
enum class Cache { shared, own };

/// A temporary folder for one test, removed at the end; commands run in it.
class Workspace {
 public:
  /// Its own cache is the folder `cache` in its folder.
  explicit Workspace(Cache cache = Cache::shared);
  [[nodiscard]] const std::filesystem::path& cache() const { return cache_; }
  [[nodiscard]] const std::filesystem::path& folder() const {
    return folder_.path();
  }
  void write(const std::string& name, const std::string& text) const;
  /// Runs `limber ARGUMENTS`, quoted for a shell.
  [[nodiscard]] CommandResult limber(const std::string& arguments) const;

 private:
  TemporaryFolder folder_;
  std::filesystem::path cache_;
};

[[nodiscard]] std::string read_text(const std::filesystem::path& file);

}  // namespace limber::test
