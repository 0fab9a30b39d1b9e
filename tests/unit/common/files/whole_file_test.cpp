// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/files/whole_file.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <set>
#include <stdexcept>

#include "limber/common/errors.hpp"
#include "limber/common/files/unfinished_files.hpp"

namespace limber::whole_file_test {
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

TEST_F(WholeFile, HasTheModeThatTheUserWants) {
  const mode_t before = umask(027);
  write_whole(file_, [&](const fs::path& part) { std::ofstream(part) << "x"; });
  umask(before);
  struct stat status = {};
  ASSERT_EQ(stat(file_.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0640U);
}

// Of two writers none can be made to write to a place that somebody prepared.
TEST_F(WholeFile, IsWrittenUnderNamesThatCannotBePredicted) {
  std::set<std::string> names;
  for (int i = 0; i < 20; ++i) {
    write_whole(file_, [&](const fs::path& part) {
      names.insert(part.filename().string());
      std::ofstream(part) << "x";
    });
  }
  EXPECT_EQ(names.size(), 20U);
}

// What a handler of signals does before the process ends.
TEST_F(WholeFile, GoesWithTheProcessWhenASignalEndsIt) {
  const pid_t child = fork();
  if (child == 0) {
    write_whole(file_, [&](const fs::path& part) {
      std::ofstream(part) << "half";
      remove_unfinished_files();
      _exit(count_files() == 1 ? 0 : 1);
    });
  }
  int status = -1;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(read(), "old");
}

TEST_F(WholeFile, RemovesWhatAKilledWriterLeftInAFolderOfItsOwn) {
  const pid_t child = fork();
  if (child == 0) {
    write_whole(file_, [&](const fs::path& part) {
      std::ofstream(part) << "half";
      kill(getpid(), SIGKILL);
    });
  }
  waitpid(child, nullptr, 0);
  ASSERT_EQ(count_files(), 2);
  std::ofstream(folder_ / "notes.part-2 of my thesis") << "the user's";
  remove_stale_parts(folder_);
  EXPECT_EQ(count_files(), 2);
  EXPECT_TRUE(fs::exists(folder_ / "notes.part-2 of my thesis"));
}

TEST_F(WholeFile, RemovesAnHourLaterWhatAKilledWriterLeftElsewhere) {
  const pid_t child = fork();
  if (child == 0) _exit(0);
  waitpid(child, nullptr, 0);
  const fs::path part = folder_ / fmt::format("file.part-{}-abc123", child);
  std::ofstream(part) << "half";
  const auto write = [&] {
    write_whole(file_, [](const fs::path& p) { std::ofstream(p) << "new"; });
  };
  write();
  EXPECT_TRUE(fs::exists(part));  // another machine's may be at work
  fs::last_write_time(part,
                      fs::file_time_type::clock::now() - std::chrono::hours(2));
  write();
  EXPECT_FALSE(fs::exists(part));
}

TEST_F(WholeFile, TellsWhyItCannotBeWritten) {
  const fs::path nowhere = folder_ / "no" / "folder";
  try {
    write_whole(nowhere, [](const fs::path&) { FAIL(); });
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("No such file or directory"),
              std::string::npos);
  }
}

}  // namespace
}  // namespace limber::whole_file_test
