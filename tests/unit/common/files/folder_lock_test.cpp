// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/files/folder_lock.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <optional>
#include <string>

#include "unit/flexbody/files.hpp"

namespace limber::folder_lock_test {
namespace {

using flexbody::test::find_input_error;
using flexbody::test::TemporaryFolder;
using ::testing::AllOf;
using ::testing::HasSubstr;

std::string refusal(const TemporaryFolder& folder) {
  return find_input_error([&] { const FolderLock lock(folder.path()); });
}

TEST(FolderLock, NamesTheProcessThatHoldsIt) {
  const TemporaryFolder folder;
  const FolderLock lock(folder.path());
  EXPECT_TRUE(lock.is_held());
  EXPECT_THAT(refusal(folder),
              AllOf(HasSubstr("in use by process " + std::to_string(getpid())),
                    HasSubstr("since "), HasSubstr("--out")));
}

TEST(FolderLock, LeavesNothingBehind) {
  const TemporaryFolder folder;
  {
    const FolderLock lock(folder.path());
    EXPECT_EQ(folder.count_files(), 1);
  }
  EXPECT_EQ(folder.count_files(), 0);
  EXPECT_EQ(refusal(folder), "");
}

TEST(FolderLock, OfAKilledProcessBlocksNobody) {
  const TemporaryFolder folder;
  int ready[2];
  ASSERT_EQ(pipe(ready), 0);
  const pid_t child = fork();
  if (child == 0) {
    const FolderLock lock(folder.path());
    static_cast<void>(!write(ready[1], "x", 1));
    pause();
    _exit(0);
  }
  char byte = 0;
  ASSERT_EQ(read(ready[0], &byte, 1), 1);
  EXPECT_THAT(refusal(folder), HasSubstr("process " + std::to_string(child)));
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  EXPECT_EQ(folder.count_files(), 1);  // the file is there, the lock is not
  EXPECT_EQ(refusal(folder), "");
  close(ready[0]);
  close(ready[1]);
}

TEST(FolderLock, FollowsNoLinkOutOfTheFolder) {
  const TemporaryFolder folder;
  const TemporaryFolder elsewhere;
  flexbody::test::write_bytes(elsewhere.path() / "mine", "precious");
  std::filesystem::create_symlink(elsewhere.path() / "mine",
                                  folder.path() / ".limber-lock");
  EXPECT_NE(refusal(folder), "");
  EXPECT_EQ(flexbody::test::read_bytes(elsewhere.path() / "mine"), "precious");
}

}  // namespace
}  // namespace limber::folder_lock_test
