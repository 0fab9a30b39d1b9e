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

/// A temporary folder for one test, removed at the end; commands run in it.
class Workspace {
 public:
  [[nodiscard]] const std::filesystem::path& folder() const {
    return folder_.path();
  }
  void write(const std::string& name, const std::string& text) const;
  /// Runs `limber ARGUMENTS`, quoted for a shell.
  [[nodiscard]] CommandResult limber(const std::string& arguments) const;

 private:
  TemporaryFolder folder_;
};

[[nodiscard]] std::string read_text(const std::filesystem::path& file);

}  // namespace limber::test
