// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/process/child_process.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <thread>

#include "limber/common/errors.hpp"
#include "limber/common/process/landlock.hpp"
#include "unit/flexbody/files.hpp"

namespace limber::child_process_test {
namespace {

using ::testing::HasSubstr;
using Clock = std::chrono::steady_clock;

constexpr std::uint64_t kMemory = 1ULL << 30;

ChildEnd run(const std::string& script, double seconds = 20.0) {
  return run_child({"/bin/sh", {"-c", script}, {"A=b"}, seconds, kMemory});
}

TEST(ChildProcess, HandsBackReplyWordsAndStatus) {
  const ChildEnd end = run("echo to3 >&3; echo words; echo more >&2; exit 5");
  EXPECT_EQ(end.reply, "to3\n");
  EXPECT_EQ(end.output, "words\nmore\n");
  EXPECT_EQ(end.exit_status, 5);
  EXPECT_EQ(end.signal, 0);
}

TEST(ChildProcess, SeesNothingOfOurs) {
  // Its input is empty; its environment is the given one.
  const ChildEnd end = run("cat; /usr/bin/env; ls /proc/self/fd | wc -l");
  EXPECT_THAT(end.output, HasSubstr("A=b\n"));
  EXPECT_THAT(end.output, ::testing::Not(HasSubstr("HOME=")));
  // 0 to 3, and that by which ls lists them.
  EXPECT_THAT(end.output, ::testing::EndsWith("5\n"));
}

TEST(ChildProcess, IsEndedWithItsWholeGroupWhenItsTimeIsOver) {
  const auto start = Clock::now();
  const ChildEnd end = run("sleep 100 & echo $!; sleep 100", 0.3);
  EXPECT_TRUE(end.is_out_of_time);
  EXPECT_LT(Clock::now() - start, std::chrono::seconds(5));
  const int grandchild = std::stoi(end.output);
  for (int i = 0; i < 1000 && kill(grandchild, 0) == 0; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  // Gone, or left for init to bury.
  const std::string state = flexbody::test::read_bytes(
      "/proc/" + std::to_string(grandchild) + "/stat");
  EXPECT_TRUE(state.empty() || state.find(") Z") != std::string::npos) << state;
}

TEST(ChildProcess, ThatTalksWithoutEndIsKeptShort) {
  const ChildEnd end = run("yes", 0.5);
  EXPECT_TRUE(end.is_out_of_time);
  EXPECT_LT(end.output.size(), 100000U);
  const ChildEnd flood =
      run_child({"/bin/sh", {"-c", "yes >&3"}, {}, 20.0, 1ULL << 28});
  EXPECT_TRUE(flood.is_reply_too_long);
}

TEST(ChildProcess, ThatDiesByASignalSaysWhich) {
  EXPECT_EQ(run("kill -SEGV $$").signal, SIGSEGV);
}

TEST(ChildProcess, HasNoMoreMemoryThanItsLimit) {
  const ChildEnd end = run("x=$(head -c 2000000000 /dev/zero | tr '\\0' a)");
  EXPECT_TRUE(end.exit_status != 0 || end.signal != 0);
}

TEST(ChildProcess, ThatIsNotThereIsAnInputError) {
  try {
    (void)run_child({"/no/such/program", {}, {}, 1.0, kMemory});
    ADD_FAILURE() << "started";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("/no/such/program"));
  }
}

TEST(ChildProcess, CannotWriteAFile) {
  const int rule = make_landlock(LandlockRule::no_writing);
  if (rule < 0) GTEST_SKIP() << "this kernel has no Landlock";
  close(rule);
  const flexbody::test::TemporaryFolder folder;
  const std::string there = folder.path() / "there";
  flexbody::test::write_bytes(there, "old");
  for (const std::string& deed :
       {"echo x > " + there + "2", "echo x > " + there, "rm " + there,
        "mkdir " + there + "3", "mv " + there + " " + there + "4",
        "ln -s a " + there + "5"}) {
    EXPECT_NE(run(deed).exit_status, 0) << deed;
  }
  EXPECT_EQ(flexbody::test::read_bytes(there), "old");
  EXPECT_EQ(folder.count_files(), 1);
}

// The parent is killed so that it can do nothing for its child.
TEST(ChildProcess, DiesWithItsParent) {
  const flexbody::test::TemporaryFolder folder;
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  const pid_t parent = fork();
  if (parent == 0) {
    close(ends[0]);
    (void)run("sleep 100", 100.0);
    _exit(0);
  }
  close(ends[1]);  // closed in the child, too, by exec
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  const std::string children = "/proc/" + std::to_string(parent) + "/task/" +
                               std::to_string(parent) + "/children";
  const std::string list = flexbody::test::read_bytes(children);
  kill(parent, SIGKILL);
  waitpid(parent, nullptr, 0);
  close(ends[0]);
  if (list.empty()) GTEST_SKIP() << "this kernel does not list children";
  const int child = std::stoi(list);
  for (int i = 0; i < 2000 && kill(child, 0) == 0; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  const std::string state =
      flexbody::test::read_bytes("/proc/" + std::to_string(child) + "/stat");
  EXPECT_TRUE(state.empty() || state.find(") Z") != std::string::npos) << state;
}

}  // namespace
}  // namespace limber::child_process_test
