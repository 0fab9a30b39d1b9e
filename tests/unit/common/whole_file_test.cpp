// SPDX-License-Identifier: BSD-3-Clause
#include "common/whole_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <stdexcept>

namespace limber {
namespace {

namespace fs = std::filesystem;

class WholeFile : public ::testing::Test {
 protected:
  WholeFile()
      : folder_(fs::temp_directory_path() /
                ("limber-whole-" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
    std::ofstream(file_) << "old";
  }
  ~WholeFile() override { fs::remove_all(folder_); }

  [[nodiscard]] std::string read() const {
    std::string text;
    std::ifstream(file_) >> text;
    return text;
  }
  [[nodiscard]] std::ptrdiff_t count_files() const {
    return std::distance(fs::directory_iterator(folder_),
                         fs::directory_iterator());
  }

  fs::path folder_;
  fs::path file_ = folder_ / "file";
};

TEST_F(WholeFile, StandsUntilTheNewOneIsDone) {
  write_whole(file_, [&](const fs::path& part) {
    std::ofstream(part) << "new";
    EXPECT_EQ(read(), "old");
  });
  EXPECT_EQ(read(), "new");
  EXPECT_EQ(count_files(), 1);
}

TEST_F(WholeFile, StaysAndLeavesNothingBesideItWhenWritingFails) {
  const auto fail = [&](const fs::path& part) {
    std::ofstream(part) << "half";
    throw std::runtime_error("disk full");
  };
  EXPECT_THROW(write_whole(file_, fail), std::runtime_error);
  EXPECT_EQ(read(), "old");
  EXPECT_EQ(count_files(), 1);
}

}  // namespace
}  // namespace limber
