// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>

namespace limber::testing {

/// A folder for the files of this process, which goes with it: tests that run
/// at the same time do not share files of one name.
class OwnFolder {
 public:
  OwnFolder() {
    std::string name =
        (std::filesystem::temp_directory_path() / "limber-test-XXXXXX")
            .string();
    if (mkdtemp(name.data()) == nullptr) {
      throw std::runtime_error("no temporary folder");
    }
    path_ = name;
  }
  ~OwnFolder() {
    if (getpid() != owner_) return;  // a child of ours
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  OwnFolder(const OwnFolder&) = delete;
  OwnFolder& operator=(const OwnFolder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  pid_t owner_ = getpid();
};

inline const std::filesystem::path& own_folder() {
  static const OwnFolder folder;
  return folder.path();
}

}  // namespace limber::testing
