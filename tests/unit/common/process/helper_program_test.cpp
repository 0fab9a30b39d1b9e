// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/process/helper_program.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <string>

#include "limber/common/errors.hpp"

namespace limber::helper_program_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::filesystem::path own_folder() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path();
}

TEST(HelperProgram, IsLookedForBesideTheRunningProgram) {
  const std::string own =
      std::filesystem::read_symlink("/proc/self/exe").filename();
  EXPECT_EQ(find_helper("this test", own, ""), own_folder() / own);
}

TEST(HelperProgram, ThatIsNowhereIsNamedWithThePlaces) {
  try {
    static_cast<void>(find_helper("the painter", "limber-paint", "Paint."));
    FAIL() << "found";
  } catch (const InputError& error) {
    EXPECT_THAT(
        error.what(),
        AllOf(HasSubstr("the painter 'limber-paint' was not found"),
              HasSubstr((own_folder() / "limber-paint").string()),
              HasSubstr("/libexec/limber/limber-paint"), HasSubstr("Paint.")));
  }
}

// Its number, its streams, its words; what was printed before is not lost.
TEST(HelperProgram, GoesOnInThisProcess) {
  std::array<int, 2> ends{};
  ASSERT_EQ(pipe(ends.data()), 0);
  std::fflush(stdout);  // what waits there is not the child's to print
  const pid_t child = fork();
  if (child == 0) {
    dup2(ends[1], STDOUT_FILENO);
    std::fputs("before ", stdout);
    std::string name = "limber";
    std::string option = "-c";
    std::string words = "echo $0 $$; exit 7";
    std::array<char*, 4> argv = {name.data(), option.data(), words.data(),
                                 nullptr};
    become("/bin/sh", argv.data());
  }
  close(ends[1]);
  std::string out;
  std::array<char, 200> part{};
  for (ssize_t n = 0; (n = read(ends[0], part.data(), part.size())) > 0;) {
    out.append(part.data(), static_cast<std::size_t>(n));
  }
  close(ends[0]);
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(WEXITSTATUS(status), 7);
  EXPECT_EQ(out, "before limber " + std::to_string(child) + "\n");
}

TEST(HelperProgram, ThatCannotBeStartedIsAnError) {
  std::array<char*, 1> argv = {nullptr};
  EXPECT_THROW(become("/no/such/program", argv.data()), InputError);
}

}  // namespace
}  // namespace limber::helper_program_test
